// Mean and variance of independent values, with their standard errors.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

namespace etendue::experiments {

class Moments {
 public:
  void add(double value) { values_.push_back(value); }
  size_t count() const { return values_.size(); }

  double mean() const { return moment(1, 0); }
  // Unbiased.
  double variance() const { return moment(2, mean()) * n() / (n() - 1); }
  double mean_error() const { return std::sqrt(variance() / n()); }
  // The standard error of `variance`, from the fourth central moment.
  double variance_error() const {
    const double m = mean(), second = moment(2, m);
    return std::sqrt(std::max(0.0, (moment(4, m) - second * second) / n()));
  }

 private:
  double n() const { return static_cast<double>(values_.size()); }
  double moment(int power, double around) const {
    double sum = 0;
    for (const double v : values_) sum += std::pow(v - around, power);
    return sum / n();
  }
  std::vector<double> values_;
};

// A deviation that a correct estimate exceeds once in 150,000 times, in standard errors.
inline constexpr double kStandardErrors = 4.5;

}  // namespace etendue::experiments
