#include "metrics/convergence.h"

#include <algorithm>
#include <cmath>

namespace etendue::metrics {
namespace {

double x_of(const ErrorPoint& p, Abscissa abscissa) { return abscissa == Abscissa::seconds ? p.seconds : p.spp; }
double y_of(const ErrorPoint& p, ErrorKind kind) { return kind == ErrorKind::rmse ? std::sqrt(p.mse) : p.relmse; }

// True if both logarithms exist.
bool is_drawable(double x, double y) { return x > 0 && y > 0 && std::isfinite(x) && std::isfinite(y); }

template <class F>
void for_each_drawable(const ErrorCurve& curve, Abscissa abscissa, ErrorKind kind, F&& f) {
  for (const auto& p : curve.points)
    if (is_drawable(x_of(p, abscissa), y_of(p, kind))) f(x_of(p, abscissa), y_of(p, kind));
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

// d log(m) = dm / m, with m the corrected MSE. The measured MSE, m + noise, has the same relative error at all points.
double correction_weight(double mse, double noise) { return std::pow(mse / (mse + noise), 2); }

LineFit fit_curve(const ErrorCurve& curve, Abscissa abscissa, double noise) {
  std::vector<LinePoint> points;
  for_each_drawable(curve, abscissa, ErrorKind::rmse, [&](double x, double rmse) {
    points.push_back({std::log(x), std::log(rmse), correction_weight(rmse * rmse, noise)});
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

ErrorPoint without_noise(ErrorPoint measured, const ReferenceNoise& noise) {
  measured.mse = std::max(measured.mse - noise.mse, 0.0);
  measured.relmse = std::max(measured.relmse - noise.relmse, 0.0);
  return measured;
}

MethodCurves without_noise(const MethodCurves& method, const ReferenceNoise& noise) {
  MethodCurves corrected = method;
  for (auto& curve : corrected.repeats)
    for (auto& p : curve.points) p = without_noise(p, noise);
  return corrected;
}

bool is_reference_too_noisy(const MethodCurves& corrected, const ReferenceNoise& noise) {
  for (const auto& curve : corrected.repeats)
    for (const auto& p : curve.points)
      if (p.mse < 100 * noise.mse) return true;
  return false;
}

std::vector<double> log_grid(double first, double last, int count) {
  std::vector<double> grid;
  const double step = std::log(last / first) / (count - 1);
  for (int i = 0; i < count; ++i) grid.push_back(i + 1 < count ? first * std::exp(step * i) : last);
  return grid;
}

std::optional<Range> abscissa_range(const MethodCurves& method, Abscissa abscissa) {
  std::optional<Range> range;
  for (const auto& curve : method.repeats)
    for_each_drawable(curve, abscissa, ErrorKind::rmse, [&](double x, double) {
      if (!range) range = Range{x, x};
      range = Range{std::min(range->first, x), std::max(range->last, x)};
    });
  return range;
}

std::optional<double> error_at(const ErrorCurve& curve, Abscissa abscissa, ErrorKind kind, double x) {
  std::optional<double> error;
  double last_x = 0;
  double last_y = 0;
  for_each_drawable(curve, abscissa, kind, [&](double px, double py) {
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

std::vector<BandPoint> error_band(const MethodCurves& method, Abscissa abscissa, ErrorKind kind,
                                  std::span<const double> grid) {
  std::vector<BandPoint> band;
  for (const double x : grid) {
    std::vector<double> errors;
    for (const auto& curve : method.repeats)
      if (const auto e = error_at(curve, abscissa, kind, x)) errors.push_back(*e);
    if (errors.empty() || 2 * errors.size() < method.repeats.size()) continue;
    band.push_back({x, quantile(errors, 0.1), quantile(errors, 0.5), quantile(errors, 0.9)});
  }
  return band;
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

Estimate slope_of(const MethodCurves& corrected, Abscissa abscissa, const ReferenceNoise& noise) {
  std::vector<double> slopes;
  double fit_error = 0;
  for (const auto& curve : corrected.repeats)
    if (const LineFit line = fit_curve(curve, abscissa, noise.mse); line.known) {
      slopes.push_back(line.slope);
      fit_error = line.slope_error;
    }
  Estimate slope = estimate_of(slopes);
  if (slopes.size() == 1) slope.standard_error = fit_error;
  return slope;
}

Estimate efficiency_of(const MethodCurves& corrected) {
  const Estimate cost = estimate_at_end(corrected, [](const ErrorPoint& p) { return p.mse * p.seconds; });
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
