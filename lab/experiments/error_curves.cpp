#include "experiments/error_curves.h"

#include <cmath>

namespace etendue::experiments {

std::vector<double> powers_of_two(int first, int last) {
  std::vector<double> numbers;
  for (int k = first; k <= last; ++k) numbers.push_back(std::ldexp(1.0, k));
  return numbers;
}

Result<metrics::MethodCurves> rms_error_curves(const std::string& name, std::span<const double> work,
                                               const Repeats& repeats, const ErrorsOfRepeat& errors,
                                               const RunContext& context) {
  metrics::MethodCurves curves{.name = name, .repeats = {}};
  std::vector<double> one(work.size());
  for (int group = 0; group < repeats.groups; ++group) {
    std::vector<double> squares(work.size(), 0.0);
    for (int i = 0; i < repeats.per_group; ++i) {
      const int repeat = group * repeats.per_group + i;
      if (!context.proceed(static_cast<double>(repeat) / repeats.count())) return interrupted();
      errors(repeat, one);
      for (size_t k = 0; k < work.size(); ++k) squares[k] += one[k] * one[k] / repeats.per_group;
    }
    metrics::ErrorCurve curve{.repeat = group, .points = {}};
    for (size_t k = 0; k < work.size(); ++k) curve.points.push_back({.spp = work[k], .mse = squares[k]});
    curves.repeats.push_back(std::move(curve));
  }
  return curves;
}

metrics::MethodCurves error_curve(const std::string& name, std::span<const double> work,
                                  std::span<const double> errors) {
  metrics::ErrorCurve curve;
  for (size_t k = 0; k < work.size(); ++k) curve.points.push_back({.spp = work[k], .mse = errors[k] * errors[k]});
  return {.name = name, .repeats = {curve}};
}

metrics::Estimate slope(const metrics::MethodCurves& curves, double least_work, double least_error) {
  metrics::MethodCurves kept{.name = curves.name, .repeats = {}};
  for (const metrics::ErrorCurve& curve : curves.repeats) {
    metrics::ErrorCurve part{.repeat = curve.repeat, .points = {}};
    for (const metrics::ErrorPoint& p : curve.points)
      if (p.spp >= least_work && p.mse > least_error * least_error) part.points.push_back(p);
    kept.repeats.push_back(std::move(part));
  }
  return metrics::slope_of(kept, metrics::Abscissa::samples);
}

}  // namespace etendue::experiments
