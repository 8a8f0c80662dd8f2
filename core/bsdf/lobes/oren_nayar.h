// The qualitative model of Oren and Nayar: Lambertian V-grooves.                                  [Oren and Nayar 1994]
//
//   f = rho / pi (A + B max(0, cos dphi) sin a tan b),  a = max(theta_o, theta_i), b = min(theta_o, theta_i)
//   A = 1 - s^2 / (2 (s^2 + 0.33)),  B = 0.45 s^2 / (s^2 + 0.09)
//
// s is the standard deviation of the slope angle in radians. sin a tan b cos dphi equals <o_t, i_t> / max(cos_o, cos_i)
// of the tangential parts. Reciprocal. Sampled by the cosine.
#pragma once
#include "bsdf/lobes/opaque_lobe.h"

namespace etendue {

template <class ColorType>
struct OrenNayar : OpaqueLobe<ColorType, OrenNayar<ColorType>, ScatterType::diffuse> {
  ColorType albedo{0};
  float a = 1, b = 0;

  // sigma is s in radians.
  static OrenNayar with_slope(const ColorType& albedo, float sigma) {
    OrenNayar lobe;
    const float s2 = sqr(sigma);
    lobe.albedo = albedo;
    lobe.a = 1 - 0.5f * s2 / (s2 + 0.33f);
    lobe.b = 0.45f * s2 / (s2 + 0.09f);
    return lobe;
  }

  ColorType f(const Vec3& o, const Vec3& i) const {
    const float grooves = std::max(0.0f, o.x * i.x + o.y * i.y) / std::max(o.z, i.z);
    return albedo * (kInvPi * (a + b * grooves));
  }
  float density(const Vec3&, const Vec3& i) const { return cosine_hemisphere_pdf(i.z); }
  bool sample_direction(const Vec3&, const LobeRandom& random, Vec3& i) const {
    i = random.cosine_direction;
    return true;
  }
  float sampling_weight(const Vec3&) const { return average(albedo) * a; }
  float alpha() const { return 1; }
};

}  // namespace etendue
