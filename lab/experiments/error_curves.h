// Root mean square errors over work, estimated by repeating a calculation.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "experiments/experiment.h"

namespace etendue::experiments {

// Numbers 2^first .. 2^last.
std::vector<double> powers_of_two(int first, int last);

// The repeats are divided into groups. Each group gives one curve of root mean square errors, so that the spread of the
// groups is the uncertainty of the curve and of its slope.
struct Repeats {
  int groups = 8;
  int per_group = 16;
  int count() const { return groups * per_group; }
};

// `errors(repeat, out)` writes the error of one independent calculation after each amount of work. Nothing if the run was
// interrupted.
using ErrorsOfRepeat = std::function<void(int repeat, std::span<double> out)>;
Result<metrics::MethodCurves> rms_error_curves(const std::string& name, std::span<const double> work,
                                               const Repeats& repeats, const ErrorsOfRepeat& errors,
                                               const RunContext& context);

// A curve with one repeat.
metrics::MethodCurves error_curve(const std::string& name, std::span<const double> work,
                                  std::span<const double> errors);

// The slope in logarithmic coordinates, its standard error zero for one repeat. `least_work` leaves out the beginning,
// where the asymptotic rate does not hold yet; errors below `least_error` are rounding errors.
metrics::Estimate slope(const metrics::MethodCurves& curves, double least_work = 0, double least_error = 0);

}  // namespace etendue::experiments
