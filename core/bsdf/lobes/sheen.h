// The sheen of glTF: backscattering by fibres along the normal.                                  [KHR_materials_sheen]
//
//   f = color D V / max(1, E(cos_o), E(cos_i)),   D = (2 + 1 / a) sin_h^(1 / a) / (2 pi),   a = roughness^2
//   V = 1 / (4 cos_o cos_i (1 + L(cos_o) + L(cos_i)))                              fit of L: [Estevez and Kulla 2017]
//
// E is the directional albedo of D V. The fit of L makes it exceed 1 at grazing angles for roughnesses below 0.3 (2.9
// for 0.07); the divisor removes that excess and changes no other direction. Reciprocal. Sampled uniformly over the
// hemisphere: the relative variance of the estimated albedo is 0.2 to 2.5 for roughnesses of at least 0.3, against 0.6
// to 47 when sampling by D and 0.3 to 8.5 when sampling by the cosine.
#pragma once
#include "bsdf/lobes/opaque_lobe.h"
#include "bsdf/microfacet/cosine_exponent.h"

namespace etendue {

// Smaller roughnesses are clamped: the table does not resolve the lobe, whose albedo vanishes except at grazing angles.
inline constexpr float kMinSheenRoughness = 0.07f;

// E, from a table that is computed at first use. Thread-safe.
float sheen_albedo(float cosine, float roughness);

// D V for two directions above the surface.
float sheen_shape(const Vec3& o, const Vec3& i, float roughness);

template <class ColorType>
struct Sheen : OpaqueLobe<ColorType, Sheen<ColorType>> {
  ColorType color{0};
  float roughness = 1;

  ColorType f(const Vec3& o, const Vec3& i) const {
    const float largest = std::max(sheen_albedo(o.z, roughness), sheen_albedo(i.z, roughness));
    return color * (sheen_shape(o, i, roughness) / std::max(1.0f, largest));
  }
  float density(const Vec3&, const Vec3&) const { return 0.5f * kInvPi; }
  bool sample_direction(const Vec3&, const LobeRandom& random, Vec3& i) const {
    i = square_to_cosine_power(random.u, 0);
    return true;
  }
  float sampling_weight(const Vec3& wo) const {
    return average(color) * std::min(1.0f, sheen_albedo(std::abs(wo.z), roughness));
  }
  float alpha() const { return 1; }
};

// The attenuation of the lobes below a sheen (coating_layers.h).
struct SheenCoating {
  float strength = 0;  // largest component of the sheen colour
  float roughness = 1;

  float albedo(const Vec3& w) const { return strength * std::min(1.0f, sheen_albedo(std::abs(w.z), roughness)); }
};

}  // namespace etendue
