#include "light/environments/hosek_model.h"

#include <algorithm>
#include <cmath>

#include "light/environments/hosek_data.h"
#include "light/environments/sky_color.h"

namespace etendue {
namespace {

constexpr double kHosekLumensPerWatt = 683;

// A quintic Bezier curve with control points `stride` apart.
double hosek_curve(const double* points, size_t stride, double t) {
  const double s = 1 - t;
  const double weights[] = {s * s * s * s * s,      5 * s * s * s * s * t, 10 * s * s * s * t * t,
                            10 * s * s * t * t * t, 5 * s * t * t * t * t, t * t * t * t * t};
  double sum = 0;
  for (size_t k = 0; k < 6; ++k) sum += weights[k] * points[k * stride];
  return sum;
}

// Interpolates curve(albedo, turbidity) between the integer albedos 0 and 1 and turbidities from 1 to 10, counted from
// 0.
template <class Curve>
double hosek_interpolated(double albedo, double turbidity, Curve&& curve) {
  const double position = std::clamp(turbidity, 1.0, 10.0) - 1;
  const size_t low = std::min(static_cast<size_t>(position), size_t{8});
  const double t = position - static_cast<double>(low);
  const auto between = [&](size_t level) { return (1 - albedo) * curve(0, level) + albedo * curve(1, level); };
  return (1 - t) * between(low) + t * between(low + 1);
}

}  // namespace

HosekSky::HosekSky(const Sky& sky) : sun_(sun_direction(sky)) {
  const auto albedo = static_cast<double>(sky.ground_albedo), turbidity = static_cast<double>(sky.turbidity);
  const double elevation = std::clamp(static_cast<double>(sun_angles(sky).elevation), 0.0, M_PI / 2);
  const double t = std::cbrt(elevation / (M_PI / 2));
  for (size_t c = 0; c < components_.size(); ++c) {
    for (size_t k = 0; k < 9; ++k)
      components_[c].shape[k] = hosek_interpolated(albedo, turbidity, [&](size_t ground, size_t level) {
        return hosek_curve(&kHosekShape[c][ground][level][0][k], 9, t);
      });
    components_[c].mean = hosek_interpolated(albedo, turbidity, [&](size_t ground, size_t level) {
      return hosek_curve(kHosekMean[c][ground][level], 1, t);
    });
  }
}

std::array<double, 3> HosekSky::xyz(double cos_theta, double gamma) const {
  const double cosine = std::cos(gamma);
  std::array<double, 3> result{};
  for (size_t c = 0; c < components_.size(); ++c) {
    const auto& [a, b, c0, d, e, f, g, i, h] = components_[c].shape;
    const double chi = (1 + cosine * cosine) / std::pow(1 + h * h - 2 * h * cosine, 1.5);
    result[c] = kHosekLumensPerWatt * components_[c].mean * (1 + a * std::exp(b / (cos_theta + 0.01))) *
                (c0 + d * std::exp(e * gamma) + f * cosine * cosine + g * chi + i * std::sqrt(cos_theta));
  }
  return result;
}

Rgb HosekSky::radiance(const Vec3& direction) const {
  const double cos_theta = std::clamp(static_cast<double>(direction.y), 0.0, 1.0);
  const double gamma = std::acos(std::clamp(static_cast<double>(glm::dot(direction, sun_)), -1.0, 1.0));
  const auto [x, y, z] = xyz(cos_theta, gamma);
  return rgb_of_sky(x, y, z);
}

}  // namespace etendue
