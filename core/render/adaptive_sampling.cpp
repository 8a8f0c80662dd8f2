#include "render/adaptive_sampling.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "base/vec.h"
#include "render/prepared_document.h"

namespace etendue::render {
namespace {

// The constant in the denominator of relMSE.
constexpr double kRelativeErrorOffset = 0.01;

// Rounds down to an eighth of an octave. Digital nets are most uniform at powers of two, and the variance estimate does
// not justify a finer resolution.
uint32_t rounded_down(double samples) {
  const auto n = static_cast<uint32_t>(std::min(samples, 1e9));
  const uint32_t unit = std::max(1U, std::bit_floor(std::max(n, 1U)) / 8);
  return n / unit * unit;
}

}  // namespace

SampleAllocation::SampleAllocation(Adaptive goal, std::vector<int> pixels)
    : goal_(goal),
      pixels_(std::move(pixels)),
      pixel_count_(std::accumulate(pixels_.begin(), pixels_.end(), 0.0)),
      targets_(pixels_.size()) {
  begin_uniform();
  set_range(0);
}

void SampleAllocation::begin_uniform() {
  uniform_ = true;
  largest_target_ = 1U << power_;
  for (auto& halves : targets_) halves.fill(largest_target_);
}

void SampleAllocation::begin_adaptive(const film::TileVariance& variance) {
  uniform_ = false;
  allocate(variance, 0);
  allocate(variance, 1);
  largest_target_ = 0;
  for (const auto& halves : targets_) largest_target_ = std::max({largest_target_, halves[0], halves[1]});
}

// The standard deviation of one sample, relative to the mean if the goal is the relative error.
double SampleAllocation::deviation(const film::TileVariance::Moments& tile) const {
  const double variance = std::max(0.0, double{tile.variance});
  return std::sqrt(goal_ == Adaptive::relmse ? variance / (sqr(double{tile.mean}) + kRelativeErrorOffset) : variance);
}

// Samples are proportional to the deviation, but at least those of the uniform part. Bisection finds the factor for
// which the samples of all pixels add up to the budget.
void SampleAllocation::allocate(const film::TileVariance& variance, uint32_t half) {
  const double least = std::exp2(power_);
  const double budget = 2 * least * pixel_count_;
  const auto samples = [&](size_t block, double factor) {
    return std::max(least, factor * deviation(variance.recorded(block, 1 - half, power_)));
  };
  const auto cost = [&](double factor) {
    double sum = 0;
    for (size_t b = 0; b < pixels_.size(); ++b) sum += samples(b, factor) * pixels_[b];
    return sum;
  };
  double low = 0, high = least;
  for (int i = 0; i < 60 && cost(high) < budget; ++i) {
    low = high;
    high *= 4;
  }
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (cost(middle) < budget ? low : high) = middle;
  }
  const bool no_variance = cost(high) < budget;  // then all blocks receive the same number
  for (size_t b = 0; b < pixels_.size(); ++b)
    targets_[b][half] = no_variance ? static_cast<uint32_t>(2 * least) : rounded_down(samples(b, low));
}

void SampleAllocation::advance(const film::TileVariance& variance) {
  if (range_.end < largest_target_) return set_range(range_.end);
  const uint32_t done = 1U << power_;
  if (uniform_ && power_ < film::TileVariance::kEndPower) {
    begin_adaptive(variance);
  } else {
    ++power_;
    begin_uniform();
  }
  set_range(done);
}

// Ranges grow with the number of samples and do not cross the windows of the samplers' tables.
void SampleAllocation::set_range(uint32_t first) {
  const uint32_t end = first + std::max(1U, first / 32);
  const uint32_t window_end = (first / kTableSamples + 1) * kTableSamples;
  range_ = {first, std::min({end, window_end, largest_target_})};
}

}  // namespace etendue::render
