// Mean and standard error over independent replicates. The samples within a replicate are points of a low-discrepancy
// sequence, so their own variance does not measure the error of their mean.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace etendue::bsdf_analysis {

inline constexpr uint32_t kReplicates = 16;

class Replicates {
 public:
  void add(double value) { values_[count_++] = value; }  // at most kReplicates times

  double mean() const {
    double sum = 0;
    for (size_t i = 0; i < count_; ++i) sum += values_[i];
    return sum / static_cast<double>(count_);
  }
  double standard_error() const {
    const double m = mean();
    double squares = 0;
    for (size_t i = 0; i < count_; ++i) squares += (values_[i] - m) * (values_[i] - m);
    const auto n = static_cast<double>(count_);
    return std::sqrt(squares / (n * (n - 1)));
  }

 private:
  std::array<double, kReplicates> values_{};
  size_t count_ = 0;
};

}  // namespace etendue::bsdf_analysis
