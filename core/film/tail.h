// Statistics of the upper tail of an estimator's samples: whether its sample variance is reliable.
//
// All of them describe the deviations of samples from their expected values, as estimated before they were drawn. A
// bright but constant region has no tail.
//
//   khat        shape parameter of the generalised Pareto distribution that fits the largest deviations. Moments of
//               order 1/khat and above are infinite: from 1/2 on the variance is infinite; above 0.7 errors estimated
//               from it are meaningless at any practical number of samples. Fit: [Zhang and Stephens 2009]; length of
//               the tail, prior on the shape and limits: [Vehtari et al. 2024].
//   vov         sum d^4 / (sum d^2)^2 - 1/n of the deviations d, the relative variance of the variance
//               [Estes and Cashwell 1978]. It decreases as 1/n if the fourth moment is finite; above 0.1 the variance
//               is not yet reliable. For a shape k above 1/2 it stays near 1 - 1/(2k), because few samples dominate the
//               sum of squares for any n.
//   brightest   share of the largest 0.01 % of the deviations in the sum of all samples. It is at most 0.0001 if no
//               sample exceeds twice the mean.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "film/tail_state.h"

namespace etendue::film {

// The largest reliable khat; smaller for few samples [Vehtari et al. 2024].
double khat_limit(uint64_t samples);

struct Tail {
  uint64_t samples = 0;
  // Empty for fewer than 25 samples, or if fewer than five exceed the threshold of the tail. -1, as for the uniform
  // distribution, if none does.
  std::optional<double> khat;
  double khat_error = 0;  // approximate standard error of khat
  double vov = 0;
  double brightest_share = 0;
  bool brightest_share_is_lower_bound = false;  // some of the largest were not stored

  bool heavy() const { return khat && *khat > khat_limit(samples); }
  // The probability of an estimate of at least khat if the shape is 1/2, the limit of infinite variance; 1 if unknown.
  double p_value() const;
};

// The shape parameter of the generalised Pareto distribution of exceedances over a threshold: at least 5, ascending, all
// positive. The prior draws it towards 1/2 with the weight of ten samples.
double fit_pareto(std::span<const double> exceedances);

// Accumulates deviations and stores the largest of them: between 3/4 of the capacity and the capacity. Deviations below
// the threshold cost one comparison. Reports use at most 3/4 of the capacity, so they do not depend on the order of the
// deviations, except for the rounding of the sums.
class TailAccumulator {
 public:
  // The tail has the length of [Vehtari et al. 2024] up to (capacity / 4)^2 samples. The share of the brightest is exact
  // up to 7500 capacity samples.
  explicit TailAccumulator(size_t capacity = 8192) : capacity_(capacity) {}
  // An accumulator that continues from a state.
  TailAccumulator(size_t capacity, const TailState& state);

  // Adds finite deviations. Negative ones are not part of the tail but of the variance. `sum` is the sum of the samples
  // themselves.
  void add(std::span<const float> deviations, double sum);
  // Adds another accumulator. The tail is complete above the larger of both thresholds.
  void merge(const TailAccumulator& other);
  void clear();

  uint64_t samples() const { return samples_; }
  double sum() const { return sum_; }
  // The stored deviations, unordered.
  std::span<const float> largest() const { return largest_; }
  Tail report() const;
  TailState state() const;
  size_t capacity() const { return capacity_; }

 private:
  void add_run(std::span<const float> run);
  void store(float x);
  double vov() const;

  size_t capacity_;
  uint64_t samples_ = 0;
  double sum_ = 0, squares_ = 0, fourths_ = 0;
  float threshold_ = 0;  // all deviations above it are stored
  std::vector<float> largest_;
};

}  // namespace etendue::film
