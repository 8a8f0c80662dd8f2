// A logarithmic axis of a chart: where values lie on it, and where its ticks are.
#pragma once
#include <string>
#include <vector>

namespace etendue::metrics {

class LogAxis {
 public:
  // From values to places: `low` comes to lie at `at_low`, `high` at `at_high`. 0 < low < high.
  LogAxis(double low, double high, double at_low, double at_high);

  double place(double value) const;
  double value(double place) const;
  double low() const { return low_; }
  double high() const { return high_; }

  struct Tick {
    double value;
    std::string label;  // empty for a thin line between two labels
  };
  // Powers of ten with labels, and the eight values in between; where the axis is shorter than three powers, 2 and 5
  // have labels too.
  std::vector<Tick> ticks() const;

 private:
  double low_, high_, at_low_, at_high_;
};

// As few digits as say it: "0.01", "20", "1e-5".
std::string short_number(double value);

}  // namespace etendue::metrics
