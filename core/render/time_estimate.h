// Prediction of the time at which a rendering reaches a target error.
//
// The error falls as samples^-s, whatever its measure. For independent random numbers s is 1/2, and deviations from it are chance. For
// quasi-Monte Carlo points s lies between 1/2 and 1, depending on the smoothness of the image's integrands. A straight
// line is fitted to the measured errors over logarithms, weighted by their certainty, with a prior for s (Bayesian
// linear regression). The interval combines the uncertainties of the line, of the present error and of the future one.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "film/error_measure.h"

namespace etendue::render {

struct Prediction {
  double seconds = 0;
  film::Interval interval;  // 80 % confidence
};

class TimeEstimator {
 public:
  // `independent`: the samples are independent random numbers. Otherwise they are the points of a quasi-Monte Carlo
  // sequence.
  explicit TimeEstimator(bool independent = false) : independent_(independent) {}

  // Adds the error after `samples` per pixel, which took `seconds` in all. The number of samples must exceed that of
  // the call before.
  void add(uint32_t samples, double seconds, const film::MeasuredError& error);
  // The same for the RMSE.
  void add(uint32_t samples, double seconds, const film::ErrorEstimate& error) {
    add(samples, seconds, film::measured_rmse(error));
  }

  // The remaining time until the error is `target`, which must be positive, for a rendering that has taken `seconds` so
  // far. Nothing while there is no known error.
  std::optional<Prediction> time_to(double target, double seconds) const;

  // The exponent s and its standard error.
  struct Exponent {
    double value, error;
  };
  Exponent exponent() const;

 private:
  struct Point {
    double samples, seconds;
    double log_value, error;  // `error`: standard error of the logarithm
  };
  // log value = height - exponent (log samples - middle). The errors of height and exponent are independent.
  struct Line {
    double middle, height, height_error;
    Exponent exponent;
  };
  Exponent prior() const;
  Line fit_line() const;

  bool independent_;
  std::vector<Point> history_;  // sample counts grow by about a factor of two, except for the last
};

}  // namespace etendue::render
