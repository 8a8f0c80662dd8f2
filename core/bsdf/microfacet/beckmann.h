// The Beckmann distribution of microfacet normals with Smith's height-correlated masking and shadowing, anisotropic.
//
//   D(h)      = exp(-tan^2 (cos^2 phi / a_x^2 + sin^2 phi / a_y^2)) / (pi a_x a_y cos^4)    [Lang, eq. 4.291, corrected]
//   Lambda(w) = (erf(a) - 1) / 2 + exp(-a^2) / (2 a sqrt(pi)),   a = cos / (alpha sin) in the azimuth of w [Heitz 2014]
//
// tan, cos and phi belong to h. Slopes are normally distributed with standard deviations a_x / sqrt(2) and a_y /
// sqrt(2); alpha is the root mean square slope. Visible normals are sampled by the slopes that are visible from wo
// [Heitz and d'Eon 2014; Jakob 2014]. The marginal density along the azimuth of wo is inverted by Newton steps within a
// bracket; the slope across it is normally distributed.
#pragma once
#include "base/vec.h"

namespace etendue {

// The inverse error function: erf(inverse_erf(x)) = x to 3e-7 for |x| < 1 [Giles 2010].
inline float inverse_erf(float x) {
  const auto polynomial = [](float w, const float(&c)[9]) {
    float p = c[0];
    for (int k = 1; k < 9; ++k) p = c[k] + p * w;
    return p;
  };
  static constexpr float kCentre[9] = {2.81022636e-08f,  3.43273939e-07f, -3.5233877e-06f,
                                       -4.39150654e-06f, 0.00021858087f,  -0.00125372503f,
                                       -0.00417768164f,  0.246640727f,    1.50140941f};
  static constexpr float kTail[9] = {-0.000200214257f, 0.000100950558f, 0.00134934322f, -0.00367342844f, 0.00573950773f,
                                     -0.0076224613f,   0.00943887047f,  1.00167406f,    2.83297682f};
  const float w = -std::log(std::max((1 - x) * (1 + x), 1e-38f));
  return x * (w < 5 ? polynomial(w - 2.5f, kCentre) : polynomial(std::sqrt(w) - 3, kTail));
}

struct Beckmann {
  float alpha_x = 1, alpha_y = 1;
  Vec2 along{1, 0};  // unit direction of alpha_x in the tangent plane

  // D; the integral of D(h) cos_h is 1.
  float d(const Vec3& any_h) const {
    const Vec3 h = turned(any_h);
    const float cos2 = sqr(h.z);
    const float exponent = (sqr(h.x / alpha_x) + sqr(h.y / alpha_y)) / cos2;
    return exponent < 80 ? std::exp(-exponent) / (kPi * alpha_x * alpha_y * sqr(cos2)) : 0;
  }

  // |cos| Lambda, which stays finite at grazing angles.
  float projected_lambda(const Vec3& any_w) const {
    const Vec3 w = turned(any_w);
    const float spread = std::sqrt(sqr(alpha_x * w.x) + sqr(alpha_y * w.y)), z = std::abs(w.z);
    if (!(spread > 0.2f * z)) return 0;  // Lambda is below 1e-12
    const float a = z / spread;
    return std::max(0.0f, 0.5f * (spread * std::sqrt(kInvPi) * std::exp(-sqr(a)) - z * std::erfc(a)));
  }

  // Samples a normal in proportion to its area visible from wo. wo.z must be positive.
  Vec3 sample_visible(const Vec3& any_wo, Vec2 u) const {
    const Vec3 wo = turned(any_wo);
    const Vec3 v = glm::normalize(Vec3(alpha_x * wo.x, alpha_y * wo.y, wo.z));
    const float sine = std::sqrt(v.x * v.x + v.y * v.y);
    const Vec2 azimuth = sine > 0 ? Vec2(v.x, v.y) / sine : Vec2(1, 0);
    const auto along_view = static_cast<float>(visible_slope(v.z, sine, u.x));
    const float across = inverse_erf(2 * u.y - 1);
    const Vec2 slope(azimuth.x * along_view - azimuth.y * across, azimuth.y * along_view + azimuth.x * across);
    const Vec3 h = glm::normalize(Vec3(-alpha_x * slope.x, -alpha_y * slope.y, 1));
    return Vec3(along.x * h.x - along.y * h.y, along.y * h.x + along.x * h.y, h.z);
  }

 private:
  // The direction in the frame whose x axis is the axis of alpha_x.
  Vec3 turned(const Vec3& w) const { return Vec3(along.x * w.x + along.y * w.y, along.x * w.y - along.y * w.x, w.z); }

  // Samples the slope x along the azimuth of wo, for the cosine and sine of wo's polar angle. The density is
  // proportional to (cosine - x sine) exp(-x^2) where that is not negative. Its integral `below` is monotone, so that
  // Newton steps within a bracket find the root.
  static double visible_slope(double cosine, double sine, double u) {
    const double half_inv_sqrt_pi = 0.5 / std::sqrt(M_PI);
    const auto below = [&](double x) {
      return 0.5 * cosine * std::erfc(-x) + half_inv_sqrt_pi * sine * std::exp(-x * x);
    };
    double low = -6, high = cosine < 6 * sine ? cosine / sine : 6;
    const double start = below(low), target = start + u * (below(high) - start);
    double x = std::clamp<double>(inverse_erf(static_cast<float>(2 * u - 1)), low, high);
    for (int step = 0; step < 60 && high - low > 1e-9; ++step) {
      const double error = below(x) - target;
      (error > 0 ? high : low) = x;
      const double slope = (cosine - x * sine) * 2 * half_inv_sqrt_pi * std::exp(-x * x);
      const double next = slope > 0 ? x - error / slope : low;
      const double inside = next > low && next < high ? next : 0.5 * (low + high);
      if (std::abs(inside - x) < 1e-8) return inside;
      x = inside;
    }
    return x;
  }
};

}  // namespace etendue
