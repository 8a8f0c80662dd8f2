#include "measure/tail.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace etendue::measure {
namespace {

constexpr size_t kFewestExceedances = 5;
constexpr double kBrightest = 1e-4;
// Of an upper end that many samples share.
constexpr double kShapeOfAnEdge = -1;

// Samples that count as the tail: a fifth of all, but no more than grows with the root.
size_t tail_length(uint64_t samples) {
  const auto n = static_cast<double>(samples);
  return static_cast<size_t>(std::min(0.2 * n, std::ceil(3 * std::sqrt(n))));
}

double mean_log(double a, std::span<const double> x) {
  double sum = 0;
  for (const double v : x) sum += std::log1p(a * v);
  return sum / static_cast<double>(x.size());
}

// What lies above the largest value that is no tail any more, ascending; values that equal it are left out.
std::vector<double> exceedances_of(std::span<const double> descending, size_t length) {
  const double threshold = descending[length];
  std::vector<double> x;
  for (size_t i = length; i-- > 0;)
    if (descending[i] > threshold) x.push_back(descending[i] - threshold);
  return x;
}

}  // namespace

double khat_limit(uint64_t samples) {
  return samples < 10 ? 0 : std::min(1 - 1 / std::log10(static_cast<double>(samples)), 0.7);
}

// Zhang & Stephens: the likelihood with k profiled out is a function of a = k / sigma alone; a is its mean over a grid
// of candidates, which reaches to the largest exceedance.
double fit_pareto(std::span<const double> x) {
  assert(x.size() >= kFewestExceedances && x.front() > 0);
  const auto n = static_cast<double>(x.size());
  const size_t candidates = 30 + static_cast<size_t>(std::sqrt(n));
  const double quartile = x[static_cast<size_t>(n / 4 + 0.5) - 1];
  std::vector<double> a(candidates), likelihood(candidates);
  for (size_t j = 0; j < candidates; ++j) {
    const double spread = 1 - std::sqrt(static_cast<double>(candidates) / (static_cast<double>(j) + 0.5));
    a[j] = -(1 / x.back() + spread / (3 * quartile));
    const double k = mean_log(a[j], x);
    const double l = n * (std::log(a[j] / k) - k - 1);
    // Rounding can put the largest exceedance on the very end of a candidate's support.
    likelihood[j] = std::isfinite(l) ? l : std::numeric_limits<double>::lowest();
  }
  const double best = *std::max_element(likelihood.begin(), likelihood.end());
  double weights = 0, weighted = 0;
  for (size_t j = 0; j < candidates; ++j) {
    const double w = std::exp(likelihood[j] - best);
    weights += w, weighted += w * a[j];
  }
  constexpr double kPrior = 10;
  return (mean_log(weighted / weights, x) * n + 0.5 * kPrior) / (n + kPrior);
}

void TailAccumulator::add(double x) {
  assert(x >= 0 && x < 1e75);
  ++samples_;
  const double square = x * x;
  sums_[0].add(x), sums_[1].add(square), sums_[2].add(square * x), sums_[3].add(square * square);
  keep(x);
}

void TailAccumulator::keep(double x) {
  if (largest_.size() == capacity_) {
    if (capacity_ == 0 || x <= largest_.front()) return;
    std::pop_heap(largest_.begin(), largest_.end(), std::greater<>());
    largest_.back() = x;
  } else {
    largest_.push_back(x);
  }
  std::push_heap(largest_.begin(), largest_.end(), std::greater<>());
}

void TailAccumulator::merge(const TailAccumulator& other) {
  assert(capacity_ == other.capacity_);
  samples_ += other.samples_;
  for (size_t i = 0; i < 4; ++i) sums_[i].add(other.sums_[i]);
  for (const double x : other.largest_) keep(x);
}

double TailAccumulator::vov() const {
  const auto n = static_cast<double>(samples_);
  if (samples_ < 2) return 0;
  const double s1 = sums_[0].value(), s2 = sums_[1].value(), s3 = sums_[2].value(), s4 = sums_[3].value();
  const double mean = s1 / n;
  const double squares = s2 - n * mean * mean;
  const double fourth = s4 + mean * (-4 * s3 + mean * (6 * s2 - 3 * n * mean * mean));
  // Powers that cancel to within rounding: the samples are all alike.
  if (squares <= 1e-12 * s2) return 0;
  return std::max(0.0, fourth / (squares * squares) - 1 / n);
}

Tail TailAccumulator::report() const {
  Tail tail;
  tail.samples = samples_;
  tail.vov = vov();
  std::vector<double> descending = largest_;
  std::sort(descending.begin(), descending.end(), std::greater<>());

  const auto brightest = static_cast<size_t>(std::ceil(kBrightest * static_cast<double>(samples_)));
  const auto kept = std::min(brightest, descending.size());
  const double total = sums_[0].value();
  const auto end = descending.begin() + static_cast<std::ptrdiff_t>(kept);
  if (total > 0) tail.brightest = std::accumulate(descending.begin(), end, 0.0) / total;
  tail.brightest_is_bound = kept < brightest;

  if (descending.empty()) return tail;
  const size_t length = std::min(tail_length(samples_), descending.size() - 1);
  if (length < kFewestExceedances) return tail;
  const auto x = exceedances_of(descending, length);
  if (x.empty()) tail.khat = kShapeOfAnEdge;
  if (x.size() < kFewestExceedances) return tail;
  tail.khat = fit_pareto(x);
  tail.khat_error = std::max(0.0, 1 + *tail.khat) / std::sqrt(static_cast<double>(x.size()));
  return tail;
}

}  // namespace etendue::measure
