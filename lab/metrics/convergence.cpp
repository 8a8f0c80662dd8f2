#include "metrics/convergence.h"

#include <algorithm>
#include <cmath>

namespace etendue::metrics {
namespace {

using film::ErrorMeasure;

double x_of(const ErrorPoint& p, Abscissa abscissa) { return abscissa == Abscissa::seconds ? p.seconds : p.spp; }

constexpr double kCompleteShare = 0.9;
// The largest relative error of an RMSE that is due to the reference.
constexpr double kCertainty = 0.05;

double square_of(const ErrorPoint& p, ErrorMeasure measure) {
  return measure == ErrorMeasure::rmse ? p.mse : measure == ErrorMeasure::relative ? p.relmse : p.displayed_mse;
}

double square_of(const ReferenceNoise& noise, ErrorMeasure measure) {
  return measure == ErrorMeasure::rmse       ? noise.mse
         : measure == ErrorMeasure::relative ? noise.relmse
                                             : noise.displayed_mse;
}

// True if both logarithms exist.
bool is_drawable(double x, double y) { return x > 0 && y > 0 && std::isfinite(x) && std::isfinite(y); }

template <class F>
void for_each_drawable(const ErrorCurve& curve, Abscissa abscissa, ErrorMeasure measure, F&& f) {
  for (const auto& p : curve.points)
    if (is_drawable(x_of(p, abscissa), p.error(measure))) f(x_of(p, abscissa), p.error(measure));
}

// Multiplies each weight by half the distance between the two neighbours; at the ends, by half the distance to the only
// one.
void weight_by_spacing(std::vector<LinePoint>& points) {
  if (points.size() < 2) return;
  for (size_t i = 0; i < points.size(); ++i) {
    const double before = points[i > 0 ? i - 1 : i].x, after = points[std::min(i + 1, points.size() - 1)].x;
    points[i].weight *= 0.5 * (after - before);
  }
}

// d log(m) = dm / m, with m the corrected squared error. The measured one, m + noise, has the same relative error at all points.
double correction_weight(double square, double noise) { return std::pow(square / (square + noise), 2); }

LineFit fit_curve(const ErrorCurve& curve, Abscissa abscissa, ErrorMeasure measure, double noise) {
  std::vector<LinePoint> points;
  for_each_drawable(curve, abscissa, measure, [&](double x, double error) {
    points.push_back({std::log(x), std::log(error), correction_weight(error * error, noise)});
  });
  weight_by_spacing(points);
  return fit_line(points);
}

template <class F>
Estimate estimate_at_end(const MethodCurves& method, F&& value) {
  std::vector<double> values;
  for (const auto& curve : method.repeats)
    if (!curve.points.empty())
      if (const double v = value(curve.points.back()); std::isfinite(v)) values.push_back(v);
  return estimate_of(values);
}

}  // namespace

double ErrorPoint::error(ErrorMeasure measure) const { return std::sqrt(square_of(*this, measure)); }
double ReferenceNoise::error(ErrorMeasure measure) const { return std::sqrt(square_of(*this, measure)); }

ErrorPoint without_noise(ErrorPoint measured, const ReferenceNoise& noise) {
  measured.mse = std::max(measured.mse - noise.mse, 0.0);
  measured.relmse = std::max(measured.relmse - noise.relmse, 0.0);
  measured.displayed_mse = std::max(measured.displayed_mse - noise.displayed_mse, 0.0);
  return measured;
}

MethodCurves without_noise(const MethodCurves& method, const ReferenceNoise& noise) {
  MethodCurves corrected = method;
  for (auto& curve : corrected.repeats)
    for (auto& p : curve.points) p = without_noise(p, noise);
  return corrected;
}

double smallest_certain_rmse(const ReferenceNoise& noise) {
  // With q = r / m, the relative error of the RMSE is d sqrt(q^2 + 2 q) / 2.
  const double largest = 2 * kCertainty / std::max(noise.relative_error, 1e-9);
  const double ratio = std::min(1.0, std::sqrt(1 + largest * largest) - 1);
  return std::sqrt(noise.mse / ratio);
}

bool is_reference_too_noisy(const MethodCurves& corrected, const ReferenceNoise& noise) {
  const double smallest = smallest_certain_rmse(noise);
  for (const auto& curve : corrected.repeats)
    for (const auto& p : curve.points)
      if (p.mse < smallest * smallest) return true;
  return false;
}

std::vector<double> log_grid(double first, double last, int count) {
  std::vector<double> grid;
  const double step = std::log(last / first) / (count - 1);
  for (int i = 0; i < count; ++i) grid.push_back(i + 1 < count ? first * std::exp(step * i) : last);
  return grid;
}

MethodCurves complete_repeats(const MethodCurves& method, Abscissa abscissa) {
  double longest = 0;
  for (const auto& curve : method.repeats)
    if (!curve.points.empty()) longest = std::max(longest, x_of(curve.points.back(), abscissa));
  MethodCurves complete{method.name, {}};
  for (const auto& curve : method.repeats)
    if (!curve.points.empty() && x_of(curve.points.back(), abscissa) >= kCompleteShare * longest)
      complete.repeats.push_back(curve);
  return complete;
}

std::optional<Range> abscissa_range(const MethodCurves& method, Abscissa abscissa, ErrorMeasure measure) {
  std::optional<Range> all;
  for (const auto& curve : complete_repeats(method, abscissa).repeats) {
    std::optional<Range> range;
    for_each_drawable(curve, abscissa, measure, [&](double x, double) { range = {range ? range->first : x, x}; });
    if (!range) return {};
    all = all ? Range{std::max(all->first, range->first), std::min(all->last, range->last)} : range;
  }
  return all && all->first <= all->last ? all : std::nullopt;
}

std::optional<double> error_at(const ErrorCurve& curve, Abscissa abscissa, ErrorMeasure measure, double x) {
  std::optional<double> error;
  double last_x = 0;
  double last_y = 0;
  for_each_drawable(curve, abscissa, measure, [&](double px, double py) {
    if (px == x) error = py;
    if (!error && last_x > 0 && last_x < x && x < px) {
      const double t = std::log(x / last_x) / std::log(px / last_x);
      error = last_y * std::pow(py / last_y, t);
    }
    last_x = px;
    last_y = py;
  });
  return error;
}

std::vector<BandPoint> error_band(const MethodCurves& method, Abscissa abscissa, ErrorMeasure measure,
                                  std::span<const double> grid) {
  const MethodCurves complete = complete_repeats(method, abscissa);
  std::vector<BandPoint> band;
  for (const double x : grid) {
    std::vector<double> errors;
    for (const auto& curve : complete.repeats)
      if (const auto e = error_at(curve, abscissa, measure, x)) errors.push_back(*e);
    if (errors.empty() || errors.size() < complete.repeats.size()) continue;
    band.push_back({x, quantile(errors, 0.1), quantile(errors, 0.5), quantile(errors, 0.9)});
  }
  return band;
}

CurveEnd curve_end(const MethodCurves& method, Abscissa abscissa, ErrorMeasure measure) {
  const MethodCurves complete = complete_repeats(method, abscissa);
  CurveEnd end;
  end.repeats = complete.repeats.size();
  if (complete.repeats.empty()) return end;
  std::vector<double> seconds, samples;
  for (const auto& curve : complete.repeats) {
    seconds.push_back(curve.points.back().seconds);
    samples.push_back(curve.points.back().spp);
  }
  end.seconds = quantile(std::move(seconds), 0.5);
  end.spp = quantile(std::move(samples), 0.5);
  if (const auto range = abscissa_range(method, abscissa, measure)) {
    const auto band = error_band(method, abscissa, measure, {&range->last, 1});
    if (!band.empty()) end.point = band.front();
  }
  return end;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return NAN;
  std::ranges::sort(values);
  const double position = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<size_t>(position), above = std::min(below + 1, values.size() - 1);
  return values[below] + (position - static_cast<double>(below)) * (values[above] - values[below]);
}

Estimate estimate_of(std::span<const double> values) {
  if (values.empty()) return {};
  const auto n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  for (const double v : values) squares += (v - sum / n) * (v - sum / n);
  const double error = values.size() > 1 ? std::sqrt(squares / (n - 1) / n) : 0;
  return {sum / n, error, static_cast<int>(values.size()) - 1, true};
}

Estimate slope_of(const MethodCurves& corrected, Abscissa abscissa, const ReferenceNoise& noise,
                  ErrorMeasure measure) {
  std::vector<double> slopes;
  double fit_error = 0;
  for (const auto& curve : corrected.repeats)
    if (const LineFit line = fit_curve(curve, abscissa, measure, square_of(noise, measure)); line.known) {
      slopes.push_back(line.slope);
      fit_error = line.slope_error;
    }
  Estimate slope = estimate_of(slopes);
  if (slopes.size() == 1) slope.standard_error = fit_error;
  return slope;
}

Estimate efficiency_of(const MethodCurves& corrected, ErrorMeasure measure) {
  const Estimate cost =
      estimate_at_end(corrected, [&](const ErrorPoint& p) { return square_of(p, measure) * p.seconds; });
  if (!cost.known || !(cost.value > 0)) return {};
  return {1 / cost.value, cost.standard_error / (cost.value * cost.value), cost.degrees, true};
}

Estimate bias_of(const MethodCurves& method, double reference_error) {
  Estimate bias = estimate_at_end(method, [](const ErrorPoint& p) { return p.bias; });
  bias.standard_error = std::hypot(bias.standard_error, reference_error);
  return bias;
}

std::optional<BiasVariance> bias_and_variance(double mean_mse, double mse_of_mean, int repeats,
                                              const ReferenceNoise& noise) {
  if (repeats < 2) return {};
  const double n = repeats;
  return BiasVariance{(n * mse_of_mean - mean_mse) / (n - 1) - noise.mse, (mean_mse - mse_of_mean) * n / (n - 1)};
}

}  // namespace etendue::metrics
