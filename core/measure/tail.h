// Can the variance of these samples be believed? Three looks at the upper tail of an estimator's samples.
//
//   khat       shape of the generalised Pareto distribution that fits the largest samples; moments of order 1/k and
//   above
//              are infinite. Fit: Zhang & Stephens 2009; length of the tail, prior on k and limits: Vehtari, Simpson,
//              Gelman, Yao & Gabry, "Pareto Smoothed Importance Sampling", 2015 and 2024. From 1/2 on the variance is
//              infinite; above 0.7 errors that are estimated from it mean nothing at any sample count in reach.
//   vov        sum (x - m)^4 / (sum (x - m)^2)^2 - 1/n, the relative variance of the variance (Estes & Cashwell 1978).
//              Falls as 1/n where the fourth moment is finite; above 0.1 it is too early to trust the variance.
//   brightest  the share of the sum that the largest 0.01 % of the samples carry: 0.0001 where all are alike.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/exact_sum.h"

namespace etendue::measure {

// Above this khat the samples' mean and its error cannot be relied on; smaller for few samples (Vehtari et al. 2024).
double khat_limit(uint64_t samples);

struct Tail {
  uint64_t samples = 0;
  // Nothing for fewer samples than 25, or where fewer than five stand out from the rest: there is no tail to fit. -1,
  // as for the uniform distribution, where none stands out.
  std::optional<double> khat;
  double khat_error = 0;  // its standard error, about
  double vov = 0;
  double brightest = 0;
  bool brightest_is_bound = false;  // not all of the brightest were kept: the share is larger

  bool heavy() const { return khat && *khat > khat_limit(samples); }
};

// The shape k of the generalised Pareto distribution for exceedances over a threshold, in ascending order, at least 5,
// all above zero. Drawn towards 1/2 with the weight of ten samples.
double fit_pareto(std::span<const double> exceedances);

// Takes samples one by one and keeps the largest of them. What blocks took apart can be merged in any order to the same
// bits.
class TailAccumulator {
 public:
  // With `capacity` samples kept, up to (capacity / 3)^2 samples the tail is as long as Vehtari et al. have it, and up
  // to capacity / 0.0001 the share of the brightest is exact.
  explicit TailAccumulator(size_t capacity = 4096) : capacity_(capacity) {}

  // `x` is not negative and below 1e75: sums of fourth powers are kept.
  void add(double x);
  // `other` has the same capacity.
  void merge(const TailAccumulator& other);

  Tail report() const;

 private:
  void keep(double x);
  double vov() const;

  size_t capacity_;
  uint64_t samples_ = 0;
  ExactSum sums_[4];             // of powers 1 to 4
  std::vector<double> largest_;  // a heap: the smallest of them in front
};

}  // namespace etendue::measure
