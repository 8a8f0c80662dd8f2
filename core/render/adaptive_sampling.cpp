#include "render/adaptive_sampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/vec.h"
#include "render/renderer.h"

namespace etendue::render {
namespace {

// As relMSE has it.
constexpr double kDark = 0.01;

// Nets are at their best at whole powers of two; an eighth of an octave is as fine as a guess of the variance deserves.
uint32_t rounded(double samples) {
  const auto n = static_cast<uint32_t>(std::min(samples, 1e9));
  const uint32_t unit = std::max(1U, std::bit_floor(std::max(n, 1U)) / 8);
  return n / unit * unit;
}

}  // namespace

SampleAllocation::SampleAllocation(Adaptive goal, std::vector<int> pixels)
    : goal_(goal),
      pixels_(std::move(pixels)),
      all_pixels_(std::accumulate(pixels_.begin(), pixels_.end(), 0.0)),
      targets_(pixels_.size()) {
  begin_even();
  set_piece(0);
}

void SampleAllocation::begin_even() {
  even_ = true;
  most_ = 1U << power_;
  for (auto& halves : targets_) halves.fill(most_);
}

void SampleAllocation::begin_uneven(const film::TileVariance& spread) {
  even_ = false;
  share_out(spread, 0), share_out(spread, 1);
  most_ = 0;
  for (const auto& halves : targets_) most_ = std::max({most_, halves[0], halves[1]});
}

double SampleAllocation::worth(const film::TileVariance::Moments& seen) const {
  const double variance = std::max(0.0, double{seen.variance});
  return std::sqrt(goal_ == Adaptive::relmse ? variance / (sqr(double{seen.mean}) + kDark) : variance);
}

// Finds the factor between a block's deviation and its samples that spends what there is.
void SampleAllocation::share_out(const film::TileVariance& spread, uint32_t half) {
  const double least = std::exp2(power_), purse = 2 * least * all_pixels_;
  const auto samples = [&](size_t block, double factor) {
    return std::max(least, factor * worth(spread.recorded(block, 1 - half, power_)));
  };
  const auto cost = [&](double factor) {
    double sum = 0;
    for (size_t b = 0; b < pixels_.size(); ++b) sum += samples(b, factor) * pixels_[b];
    return sum;
  };
  double low = 0, high = least;
  for (int i = 0; i < 60 && cost(high) < purse; ++i) low = high, high *= 4;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (cost(middle) < purse ? low : high) = middle;
  }
  const bool all_alike = cost(high) < purse;  // nothing scatters: an even hand
  for (size_t b = 0; b < pixels_.size(); ++b)
    targets_[b][half] = all_alike ? static_cast<uint32_t>(2 * least) : rounded(samples(b, low));
}

void SampleAllocation::advance(const film::TileVariance& spread) {
  if (piece_.end < most_) return set_piece(piece_.end);
  const uint32_t done = 1U << power_;
  if (even_ && power_ < film::TileVariance::kPowers) {
    begin_uneven(spread);
  } else {
    ++power_;
    begin_even();
  }
  set_piece(done);
}

// Pieces grow with the samples there are, and stay within the tables of the samplers.
void SampleAllocation::set_piece(uint32_t first) {
  const uint32_t end = first + std::max(1U, first / 32), table_end = (first / kTableSamples + 1) * kTableSamples;
  piece_ = {first, std::min({end, table_end, most_})};
}

}  // namespace etendue::render
