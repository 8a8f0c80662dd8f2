// The isotropic distributions of microfacet normals of the Cook-Torrance model.
//
//   gaussian   D = c exp(-theta^2 / m^2)                       [Blinn 1977; Lang, eq. 4.290]
//              c normalises D: 32.043762, 3.754119, 1.499914, 0.581188 for m = 0.1, 0.3, 0.5, 1
//   beckmann   D = exp(-tan^2 / m^2) / (pi m^2 cos^4)          [Lang, eq. 4.291, corrected]
//
// theta is the angle between the microfacet normal and the surface normal, m the root mean square slope. Both are
// normalised: the integral of D cos is 1. The thesis prints Beckmann's D without 1 / pi, which is a factor of the whole
// specular term there.
#pragma once
#include <array>

#include "base/parameter.h"

namespace etendue {

enum class SlopeKind : uint8_t { beckmann, gaussian };

// The constant c of the Gaussian distribution, by Simpson's rule in theta / m.
inline float gaussian_slope_normalisation(float m) {
  constexpr int kSteps = 128;
  const double top = std::min(0.5 * M_PI / m, 5.5), step = top / kSteps;
  double sum = 0;
  for (int k = 1; k <= kSteps; ++k) {
    const double x = k * step;
    sum += (k == kSteps ? 1 : k % 2 == 1 ? 4 : 2) * std::exp(-sqr(x)) * std::sin(2 * m * x);
  }
  return static_cast<float>(3 / (M_PI * m * step * sum));
}

struct SlopeDistribution {
  SlopeKind kind = SlopeKind::beckmann;
  float m = 0.3f;
  float weight = 1;  // in a sum of distributions
  float c = 1;       // normalisation of the Gaussian

  static SlopeDistribution of(SlopeKind kind, float m, float weight) {
    return {kind, m, weight, kind == SlopeKind::gaussian ? gaussian_slope_normalisation(m) : 1};
  }

  // D(h)
  float d(const Vec3& h) const {
    if (kind == SlopeKind::gaussian) return c * std::exp(-sqr(angle(h) / m));
    const float cos2 = sqr(h.z), exponent = (sqr(h.x) + sqr(h.y)) / (cos2 * sqr(m));
    return exponent < 80 ? std::exp(-exponent) / (kPi * sqr(m * cos2)) : 0;
  }

  // Samples a normal. Beckmann: density D cos per solid angle. Gaussian: density in theta proportional to
  // theta exp(-theta^2 / m^2), which is that of D for small angles.
  Vec3 sample(Vec2 u) const {
    const float phi = 2 * kPi * u.y;
    float sine, cosine;
    if (kind == SlopeKind::gaussian) {
      const float theta = m * std::sqrt(-std::log(1 - u.x * (1 - part_below_horizon())));
      sine = std::sin(theta);
      cosine = std::cos(theta);
    } else {
      const float tan2 = -sqr(m) * std::log(1 - u.x);
      cosine = 1 / std::sqrt(1 + tan2);
      sine = std::sqrt(tan2) * cosine;
    }
    return {sine * std::cos(phi), sine * std::sin(phi), std::max(cosine, 0.0f)};
  }
  // Density of `sample` per solid angle of h.
  float density(const Vec3& h) const {
    if (kind == SlopeKind::beckmann) return d(h) * h.z;
    const float theta = angle(h), sine = std::sqrt(sqr(h.x) + sqr(h.y));
    return std::exp(-sqr(theta / m)) / (kPi * sqr(m) * (1 - part_below_horizon())) * (sine > 0 ? theta / sine : 1);
  }

 private:
  static float angle(const Vec3& h) { return std::atan2(std::sqrt(sqr(h.x) + sqr(h.y)), h.z); }
  // The part of the density theta exp(-theta^2 / m^2) beyond 90 degrees.
  float part_below_horizon() const { return std::exp(-sqr(0.5f * kPi / m)); }
};

}  // namespace etendue

template <>
struct etendue::Options<etendue::SlopeKind> {
  static constexpr std::array<etendue::Option, 2> kOptions{
      {{"beckmann", "Beckmann"}, {"gaussian", "Gaussian (Blinn)"}}};
};
