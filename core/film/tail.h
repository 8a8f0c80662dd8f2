// Can the variance of these samples be believed? Three looks at the upper tail of an estimator's samples.
//
// What is looked at is a sample's deviation from what was expected of it before it was drawn. A constant is no tail,
// however bright.
//
//   khat       shape of the generalised Pareto distribution that fits the largest deviations; moments of order 1/k and
//   above
//              are infinite. Fit: Zhang & Stephens 2009; length of the tail, prior on k and limits: Vehtari, Simpson,
//              Gelman, Yao & Gabry, "Pareto Smoothed Importance Sampling", 2015 and 2024. From 1/2 on the variance is
//              infinite; above 0.7 errors that are estimated from it mean nothing at any sample count in reach.
//   vov        sum d^4 / (sum d^2)^2 - 1/n of the deviations, the relative variance of the variance (Estes & Cashwell
//              1978). Falls as 1/n where the fourth moment is finite; above 0.1 it is too early to trust the variance.
//              Stays near 1 - 1/(2k) for k above 1/2: the sum of squares lies in a few hands, however many are drawn.
//   brightest  the share of the samples' sum that the largest 0.01 % of the deviations carry: below 0.0001 where no
//              sample is worth more than two.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace etendue::film {

// Above this khat the samples' mean and its error cannot be relied on; smaller for few samples (Vehtari et al. 2024).
double khat_limit(uint64_t samples);

struct Tail {
  uint64_t samples = 0;
  // Nothing for fewer samples than 25, or where fewer than five stand out from the rest: there is no tail to fit. -1,
  // as for the uniform distribution, where none stands out.
  std::optional<double> khat;
  double khat_error = 0;  // its standard error, about
  double vov = 0;
  double brightest_share = 0;
  bool brightest_share_is_lower_bound = false;  // not all of the brightest were kept: the share is larger

  bool heavy() const { return khat && *khat > khat_limit(samples); }
  // The probability of a khat this large by chance where the variance is only just infinite, k = 1/2; 1 if unknown.
  double p_value() const;
};

// The shape k of the generalised Pareto distribution for exceedances over a threshold, in ascending order, at least 5,
// all above zero. Drawn towards 1/2 with the weight of ten samples.
double fit_pareto(std::span<const double> exceedances);

// Takes deviations and keeps the largest of them, at least half of its capacity and less than all of it: what is under
// the threshold costs one comparison. The same deviations in the same order give the same report to the bit; in another
// order the sums round differently, and the tail may be longer or shorter.
class TailAccumulator {
 public:
  // With `capacity` numbers of memory, up to (capacity / 6)^2 samples the tail is as long as Vehtari et al. have it,
  // and up to capacity / 0.0002 the share of the brightest is exact.
  explicit TailAccumulator(size_t capacity = 8192) : capacity_(capacity) {}

  // Deviations of finite numbers, which may be negative: then they are no tail, but add to the variance. `sum` is that
  // of the samples themselves.
  void add(std::span<const float> deviations, double sum);
  // Sums and sizes of `other`, and of what it kept the largest. What is above the higher of both thresholds is whole.
  void merge(const TailAccumulator& other);
  void clear();

  uint64_t samples() const { return samples_; }
  double sum() const { return sum_; }
  // The largest deviations, in no order.
  std::span<const float> largest() const { return kept_; }
  Tail report() const;

 private:
  void add_run(std::span<const float> run);
  void keep(float x);
  double vov() const;

  size_t capacity_;
  uint64_t samples_ = 0;
  double sum_ = 0, squares_ = 0, fourths_ = 0;
  float threshold_ = 0;  // what is above it was kept
  std::vector<float> kept_;
};

}  // namespace etendue::film
