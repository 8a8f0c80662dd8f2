// When will a rendering have the error that is asked for?
//
// RMSE falls as samples^-s: s is 1/2 for random numbers, and up to 1 for quasi-Monte Carlo points where the picture is
// smooth. What is known beforehand (1/2, give or take a tenth) and what this rendering has shown so far are weighted by
// their certainties; the uncertainty of s and that of the error itself make the interval.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "film/error.h"

namespace etendue::render {

struct Prediction {
  double seconds = 0;
  film::Interval interval;  // of 80 %
};

class Forecast {
 public:
  void clear() { history_.clear(); }
  // The error at so many samples of every pixel, more than the last time. `seconds` are those spent on them.
  void add(uint32_t samples, double seconds, const film::ErrorEstimate& error);

  // Until the RMSE is `target`, above zero, from `now` on, in seconds spent; nothing while that cannot be told.
  std::optional<Prediction> until(double target, double now) const;

  // The exponent s, and its standard error.
  struct Exponent {
    double value, error;
  };
  Exponent exponent() const;

 private:
  struct Point {
    double samples, seconds;
    double log_rmse, error;  // the standard error of the logarithm
  };
  std::vector<Point> history_;
};

}  // namespace etendue::render
