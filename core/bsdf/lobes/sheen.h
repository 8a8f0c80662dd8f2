// The sheen of glTF: light that fibres along the normal scatter back.                             KHR_materials_sheen
//
//   f = color D V / max(1, E(cos_o), E(cos_i)),   D = (2 + 1/a) sin^(1/a)(theta_h) / (2 pi),   a = roughness^2
//   V = 1 / (4 cos_o cos_i (1 + L(cos_o) + L(cos_i)))               Estevez and Kulla, 2017, with their fit of L
//
// E is the albedo of D V. It is above one at grazing angles below a roughness of 0.3 (2.9 at 0.07), for L is fitted;
// the divisor takes that away and leaves all other directions alone. Reciprocal. Sampled uniformly over the hemisphere:
// the relative variance of the albedo's estimate is 0.2 to 2.5 for roughnesses of 0.3 and more, that of sampling by D
// 0.6 to 47, by the cosine 0.3 to 8.5.
#pragma once
#include "bsdf/lobes/opaque_lobe.h"
#include "bsdf/microfacet/cosine_exponent.h"

namespace etendue {

// Below this the lobe is narrower than its table resolves, and has next to no albedo but at the rim.
inline constexpr float kLeastSheenRoughness = 0.07f;

// E of a colour of one; a table made when it is first asked for.
float sheen_albedo(float cosine, float roughness);

// D V of two directions above the surface.
float sheen_shape(const Vec3& o, const Vec3& i, float roughness);

template <class ColorType>
struct Sheen : OpaqueLobe<ColorType, Sheen<ColorType>> {
  ColorType color{0};
  float roughness = 1;

  ColorType f(const Vec3& o, const Vec3& i) const {
    const float most = std::max(sheen_albedo(o.z, roughness), sheen_albedo(i.z, roughness));
    return color * (sheen_shape(o, i, roughness) / std::max(1.0f, most));
  }
  float density(const Vec3&, const Vec3&) const { return 0.5f * kInvPi; }
  bool sample_direction(const Vec3&, const LobeRandom& random, Vec3& i) const {
    return i = square_to_cosine_power(random.u, 0), true;
  }
  float sampling_weight(const Vec3& wo) const {
    return average(color) * std::min(1.0f, sheen_albedo(std::abs(wo.z), roughness));
  }
  float alpha() const { return 1; }
};

// What it takes from the layers below: `max(color)` of what a white one sends back.
struct SheenCoating {
  float strength = 0;
  float roughness = 1;

  float kept(const Vec3& w) const { return strength * std::min(1.0f, sheen_albedo(std::abs(w.z), roughness)); }
};

}  // namespace etendue
