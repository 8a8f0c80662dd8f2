// When will a rendering have the error that is asked for?
//
// RMSE falls as samples^-s. For independent random numbers s is 1/2, and what a rendering shows of it is chance; for
// quasi-Monte Carlo points it lies between 1/2 and 1, depending on how smooth the picture's integrals are. A straight
// line through the errors so far, over logarithms and weighted by their certainties, is drawn towards what is known of
// s beforehand (Bayesian linear regression). The uncertainties of the line, of the error now and of that to come make
// the interval.
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

class TimeEstimator {
 public:
  // Whether samples are independent of each other, or points that know of each other.
  explicit TimeEstimator(bool independent = false) : independent_(independent) {}

  // The error at so many samples of every pixel, more than the last time. `seconds` are those spent on them.
  void add(uint32_t samples, double seconds, const film::ErrorEstimate& error);

  // Until the RMSE is `target`, above zero, from `now` on, in seconds spent; nothing while that cannot be told.
  std::optional<Prediction> time_to(double target, double now) const;

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
  // log rmse = height - exponent (log samples - middle); the errors of height and exponent are independent.
  struct Line {
    double middle, height, height_error;
    Exponent exponent;
  };
  Line line() const;

  bool independent_;
  std::vector<Point> history_;  // in steps of about two, but for the last
};

}  // namespace etendue::render
