#include "bench/summary.h"

#include <algorithm>
#include <cmath>

#include "metrics/flip.h"
#include "metrics/metrics.h"

namespace etendue::bench {
namespace {

using metrics::ErrorPoint;

metrics::ReferenceNoise noise_of(const Reference& reference) {
  return reference.noise.value_or(metrics::ReferenceNoise{});
}

template <class F>
double median_at_end(const metrics::MethodCurves& curves, F&& value) {
  std::vector<double> values;
  for (const auto& curve : curves.repeats) values.push_back(value(curve.points.back()));
  return metrics::quantile(std::move(values), 0.5);
}

std::optional<metrics::BiasVariance> bias_variance_of(const MethodResult& result, const Reference& reference) {
  const auto& r = reference.rgb();
  double mse_of_mean = 0;
  for (size_t i = 0; i < result.mean_image.size(); ++i) mse_of_mean += std::pow(result.mean_image[i] - r[i], 2);
  mse_of_mean /= static_cast<double>(r.size());
  return metrics::bias_and_variance(result.mean_mse, mse_of_mean, static_cast<int>(result.curves.repeats.size()),
                                    noise_of(reference));
}

double flip_of(const MethodResult& result, const Reference& reference, const render::Display& display) {
  image::LayeredImage image;
  image.width = reference.image.width;
  image.height = reference.image.height;
  image.layers.push_back({"", {"R", "G", "B"}, result.image});
  const auto map = metrics::flip_map(image, reference.image, {display.exposure, display.curve});
  return map ? metrics::mean_of(*map) : NAN;
}

}  // namespace

MethodSummary summary_of(const MethodResult& result, const Reference& reference, const render::Display& display) {
  MethodSummary s;
  s.name = result.curves.name;
  if (result.curves.repeats.empty()) return s;
  const auto noise = noise_of(reference);
  const auto corrected = metrics::without_noise(result.curves, noise);
  s.slope = metrics::slope_of(corrected, metrics::Abscissa::seconds, noise);
  s.slope_over_samples = metrics::slope_of(corrected, metrics::Abscissa::samples, noise);
  s.efficiency = metrics::efficiency_of(corrected);
  s.bias = metrics::bias_of(result.curves, reference.mean_error);
  s.bias_variance = bias_variance_of(result, reference);
  s.rmse = median_at_end(corrected, [](const ErrorPoint& p) { return std::sqrt(p.mse); });
  s.relmse = median_at_end(corrected, [](const ErrorPoint& p) { return p.relmse; });
  s.displayed = median_at_end(corrected, [](const ErrorPoint& p) { return std::sqrt(p.displayed_mse); });
  s.spp = median_at_end(corrected, [](const ErrorPoint& p) { return p.spp; });
  s.seconds = median_at_end(corrected, [](const ErrorPoint& p) { return p.seconds; });
  s.rays_per_second = metrics::quantile(result.rays_per_second, 0.5);
  if (!result.startup_seconds.empty()) s.startup_seconds = metrics::quantile(result.startup_seconds, 0.5);
  s.flip = flip_of(result, reference, display);
  s.khat = result.khat;
  s.has_heavy_tail = result.has_heavy_tail;
  s.reference_too_noisy = metrics::is_reference_too_noisy(corrected, noise);
  return s;
}

std::vector<metrics::MethodCurves> corrected_curves(const Outcome& outcome, const Reference& reference) {
  std::vector<metrics::MethodCurves> curves;
  for (const auto& method : outcome.methods)
    curves.push_back(metrics::without_noise(method.curves, noise_of(reference)));
  return curves;
}

bool reference_too_noisy(const Outcome& outcome, const Reference& reference) {
  return std::ranges::any_of(corrected_curves(outcome, reference), [&](const auto& curves) {
    return metrics::is_reference_too_noisy(curves, noise_of(reference));
  });
}

double required_reference_seconds(const Outcome& outcome, const Reference& reference) {
  const metrics::ReferenceNoise noise = noise_of(reference);
  const double smallest = metrics::smallest_certain_rmse(noise);
  // The squared error of the reference, and with it the smallest certain MSE, falls as 1 / seconds.
  double factor = 1;
  for (const auto& method : outcome.methods)
    for (const auto& curve : method.curves.repeats)
      for (const auto& p : curve.points)
        factor = std::max(factor, smallest * smallest / std::max(p.mse - noise.mse, 0.01 * p.mse));
  return factor > 1 ? factor * reference.seconds : 0;
}

}  // namespace etendue::bench
