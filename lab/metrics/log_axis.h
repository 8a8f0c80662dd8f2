// A logarithmic axis of a chart: conversion between values and coordinates, and tick marks.
#pragma once
#include <string>
#include <vector>

namespace etendue::metrics {

class LogAxis {
 public:
  // Maps `low` to the coordinate `at_low` and `high` to `at_high`. 0 < low < high.
  LogAxis(double low, double high, double at_low, double at_high);

  double position(double value) const;
  double value(double position) const;
  double low() const { return low_; }
  double high() const { return high_; }

  struct Tick {
    double value;
    std::string label;  // empty for a minor tick
  };
  // Powers of ten with labels, and the eight multiples between them as minor ticks. On an axis shorter than three
  // decades, multiples of 2 and 5 are labelled as well.
  std::vector<Tick> ticks() const;

 private:
  double low_, high_, at_low_, at_high_;
};

// At most this number of significant digits in the shortest form: "0.01", "20", "1e-5".
std::string short_number(double value, int digits = 3);

// Tick marks of a linear axis at multiples of 1, 2 or 5 times a power of ten, at most `most` + 1 of them. All have labels,
// with as many digits as distinguish neighbours, but at least three. low < high, most > 0.
std::vector<LogAxis::Tick> linear_ticks(double low, double high, int most = 9);

}  // namespace etendue::metrics
