#include "film/tail.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/error_free.h"
#include "base/vectorize.h"
#include "film/tail_capacity.h"

namespace etendue::film {
namespace {

constexpr size_t kMinExceedances = 5;
constexpr double kBrightest = 1e-4;
// If no sample exceeds the threshold: many samples share the largest value.
constexpr double kNoTailShape = -1;

// The number of samples in the tail: a fifth of all, at most 3 sqrt(n).
size_t tail_length(uint64_t samples) {
  const auto n = static_cast<double>(samples);
  return static_cast<size_t>(std::min(0.2 * n, std::ceil(3 * std::sqrt(n))));
}

// Ascending differences of the tail to the threshold, the largest value below the tail. Values that equal it are left
// out.
std::vector<double> exceedances_of(std::span<const float> descending, size_t length, double threshold) {
  std::vector<double> x;
  for (size_t i = length; i-- > 0;)
    if (descending[i] > threshold) x.push_back(descending[i] - threshold);
  return x;
}

// Too many for the compiler to unroll.
constexpr size_t kLanes = 32;
constexpr size_t kRun = 512;

// Sums of powers of a run of deviations. They are accumulated in lanes, so they do not depend on the vector width.
struct Powers {
  double squares = 0, fourths = 0;
};

// Sets above[i] if group i of kLanes deviations has one above the threshold.
ETENDUE_VECTORIZE Powers accumulate(const float* d, size_t count, float threshold, int* above) {
  std::array<double, kLanes> squares{}, fourths{};
  for (size_t i = 0; i < count; i += kLanes) {
    int any = 0;
    for (size_t j = 0; j < kLanes; ++j) any |= d[i + j] > threshold ? 1 : 0;
    above[i / kLanes] = any;
    for (size_t j = 0; j < kLanes; ++j) {
      const auto x = static_cast<double>(d[i + j]);
      const double square = x * x;
      squares[j] += square;
      fourths[j] += square * square;
    }
  }
  Powers sum;
  for (size_t j = 0; j < kLanes; ++j) {
    sum.squares += squares[j];
    sum.fourths += fourths[j];
  }
  return sum;
}

// Products of 1 + a x over all x, for many values of a. Mantissas and exponents are separate, which avoids overflow.
struct Products {
  std::vector<double> mantissa;
  std::vector<int64_t> exponent;

  double log(size_t j) const { return std::log(mantissa[j]) + static_cast<double>(exponent[j]) * std::numbers::ln2; }
};

ETENDUE_VECTORIZE void multiply(const double* a, size_t count, std::span<const double> x, double* mantissa,
                                int64_t* exponent) {
  constexpr uint64_t kMantissa = (uint64_t{1} << 52) - 1, kOne = uint64_t{1023} << 52;
  for (const double v : x)
    for (size_t j = 0; j < count; ++j) {
      const auto bits = std::bit_cast<uint64_t>(mantissa[j] * (1 + a[j] * v));
      exponent[j] += static_cast<int64_t>(bits >> 52) - 1023;
      mantissa[j] = std::bit_cast<double>((bits & kMantissa) | kOne);
    }
}

Products products_of(std::span<const double> a, std::span<const double> x) {
  Products p{std::vector<double>(a.size(), 1), std::vector<int64_t>(a.size())};
  multiply(a.data(), a.size(), x, p.mantissa.data(), p.exponent.data());
  return p;
}

}  // namespace

double khat_limit(uint64_t samples) {
  return samples < 10 ? 0 : std::min(1 - 1 / std::log10(static_cast<double>(samples)), 0.7);
}

// [Zhang and Stephens 2009]: the profile likelihood is a function of a = k / sigma only. The estimate of a is the mean over
// a grid of candidates, weighted by the likelihood. The grid extends to the largest exceedance.
double fit_pareto(std::span<const double> x) {
  assert(x.size() >= kMinExceedances && x.front() > 0);
  const auto n = static_cast<double>(x.size());
  const size_t candidates = 30 + static_cast<size_t>(std::sqrt(n));
  const double quartile = x[static_cast<size_t>(n / 4 + 0.5) - 1];
  std::vector<double> a(candidates), likelihood(candidates);
  for (size_t j = 0; j < candidates; ++j) {
    const double spread = 1 - std::sqrt(static_cast<double>(candidates) / (static_cast<double>(j) + 0.5));
    a[j] = -(1 / x.back() + spread / (3 * quartile));
  }
  const Products products = products_of(a, x);
  for (size_t j = 0; j < candidates; ++j) {
    const double k = products.log(j) / n;
    const double l = n * (std::log(a[j] / k) - k - 1);
    // Rounding can place the largest exceedance on the end of a candidate's support.
    likelihood[j] = std::isfinite(l) && 1 + a[j] * x.back() > 0 ? l : std::numeric_limits<double>::lowest();
  }
  const double best = *std::max_element(likelihood.begin(), likelihood.end());
  double weights = 0, weighted = 0;
  for (size_t j = 0; j < candidates; ++j) {
    const double w = std::exp(likelihood[j] - best);
    weights += w;
    weighted += w * a[j];
  }
  constexpr double kPrior = 10;
  const std::array<double, 1> mean{weighted / weights};
  return (products_of(mean, x).log(0) + 0.5 * kPrior) / (n + kPrior);
}

double Tail::p_value() const {
  if (!khat || khat_error <= 0) return 1;
  // The standard error at k = 1/2, not that at khat.
  const double error = khat_error * 1.5 / (1 + *khat);
  return 0.5 * std::erfc((*khat - 0.5) / (error * std::numbers::sqrt2));
}

void TailAccumulator::add(std::span<const float> deviations, double sum) {
  samples_ += deviations.size();
  sum_ += sum;
  while (!deviations.empty()) {
    const auto run = deviations.first(std::min(kRun, deviations.size()));
    const size_t whole = run.size() / kLanes * kLanes;
    add_run(run.first(whole));
    std::array<float, kLanes> rest{};
    std::ranges::copy(run.subspan(whole), rest.begin());
    if (whole < run.size()) add_run(rest);
    deviations = deviations.subspan(run.size());
  }
}

void TailAccumulator::add_run(std::span<const float> run) {
  std::array<int, kRun / kLanes> above;
  const Powers powers = accumulate(run.data(), run.size(), threshold_, above.data());
  squares_ += powers.squares;
  fourths_ += powers.fourths;
  for (size_t i = 0; i < run.size(); i += kLanes) {
    if (above[i / kLanes] == 0) continue;
    for (const float x : run.subspan(i, kLanes))
      if (x > threshold_) store(x);
  }
}

void TailAccumulator::store(float x) {
  if (largest_.capacity() < capacity_) largest_.reserve(capacity_);
  largest_.push_back(x);
  if (largest_.size() < capacity_) return;
  const size_t kept = kept_deviations(capacity_);
  const auto end = largest_.begin() + static_cast<std::ptrdiff_t>(kept);
  std::nth_element(largest_.begin(), end, largest_.end(), std::greater<>());
  threshold_ = *end;
  largest_.resize(kept);
}

void TailAccumulator::merge(const TailAccumulator& other) {
  samples_ += other.samples_;
  sum_ += other.sum_;
  squares_ += other.squares_;
  fourths_ += other.fourths_;
  if (other.threshold_ > threshold_) {
    threshold_ = other.threshold_;
    std::erase_if(largest_, [&](float x) { return x <= threshold_; });
  }
  for (const float x : other.largest_)
    if (x > threshold_) store(x);
}

TailAccumulator::TailAccumulator(size_t capacity, const TailState& state)
    : capacity_(capacity),
      samples_(state.samples),
      sum_(rounded_sum(state.sum)),
      squares_(rounded_sum(state.squares)),
      fourths_(rounded_sum(state.fourths)),
      threshold_(state.threshold),
      largest_(state.largest) {}

TailState TailAccumulator::state() const {
  TailState state{.samples = samples_,
                  .sum = expansion_of({sum_}),
                  .squares = expansion_of({squares_}),
                  .fourths = expansion_of({fourths_}),
                  .threshold = threshold_,
                  .largest = largest_};
  film::merge(state, TailState(), capacity_);
  return state;
}

void TailAccumulator::clear() {
  samples_ = 0;
  sum_ = squares_ = fourths_ = 0;
  threshold_ = 0;
  largest_.clear();
}

double TailAccumulator::vov() const {
  if (samples_ < 2 || squares_ <= 0) return 0;
  return std::max(0.0, fourths_ / (squares_ * squares_) - 1 / static_cast<double>(samples_));
}

Tail TailAccumulator::report() const {
  Tail tail;
  tail.samples = samples_;
  tail.vov = vov();
  // Only those that are always kept, so that the report does not depend on the order of the deviations.
  std::vector<float> descending = largest_;
  std::sort(descending.begin(), descending.end(), std::greater<>());
  float lowest = threshold_;
  if (const size_t kept = kept_deviations(capacity_); descending.size() > kept) {
    lowest = descending[kept];
    descending.resize(kept);
  }

  const auto brightest = static_cast<size_t>(std::ceil(kBrightest * static_cast<double>(samples_)));
  const auto end = descending.begin() + static_cast<std::ptrdiff_t>(std::min(brightest, descending.size()));
  if (sum_ > 0) tail.brightest_share = std::accumulate(descending.begin(), end, 0.0) / sum_;
  // With a threshold of zero all positive deviations are stored.
  tail.brightest_share_is_lower_bound = lowest > 0 && brightest > descending.size();

  if (tail_length(samples_) < kMinExceedances) return tail;
  const size_t length = std::min(tail_length(samples_), descending.size());
  const double threshold = length < descending.size() ? descending[length] : lowest;
  const auto x = exceedances_of(descending, length, threshold);
  if (x.empty()) tail.khat = kNoTailShape;
  if (x.size() < kMinExceedances) return tail;
  tail.khat = fit_pareto(x);
  tail.khat_error = std::max(0.0, 1 + *tail.khat) / std::sqrt(static_cast<double>(x.size()));
  return tail;
}

}  // namespace etendue::film
