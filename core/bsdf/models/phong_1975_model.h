// Phong's shading of 1975, a formula for intensities instead of radiance.         [Phong 1975; Lang, eq. 4.230]
//
//   pi f cos_i = C (cos_i (1 - d) + d) + W <r, wi>^n,       r the mirror direction of wo about the normal
//
// The right side is the printed shading under a light of unit irradiance perpendicular to its direction.
//
//   Parameters   diffuse: C as a factor of the base colour; even: d, the part of C that ignores the angle of
//                incidence; weight: W; exponent: n. Phong gives 0.1 < W < 0.8 and 1 < n < 10.
//   Properties   Neither reciprocal nor energy conserving: the terms of d and W make f grow as 1 / cos_i.
//   Sampling     Cosine, uniform directions and cos^n for the three terms, each the exact shape of its term.
//   Limitations  Of historical interest; phong_model.h is the form for radiance.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/cosine_power.h"
#include "bsdf/lobes/lambert.h"

namespace etendue {

// f = scale / cos_i: every beam is reflected in the same amount, whatever its angle of incidence.
template <class ColorType>
struct InverseCosine : OpaqueLobe<ColorType, InverseCosine<ColorType>, ScatterType::diffuse> {
  ColorType scale{0};

  ColorType f(const Vec3&, const Vec3& i) const { return scale / i.z; }
  float density(const Vec3&, const Vec3&) const { return 0.5f * kInvPi; }
  bool sample_direction(const Vec3&, const LobeRandom& random, Vec3& i) const {
    i = square_to_sphere(Vec2(0.5f * random.u.x, random.u.y));
    return true;
  }
  float sampling_weight(const Vec3&) const { return 2 * kPi * average(scale); }
  float alpha() const { return 1; }
};

struct Phong1975Model {
  static constexpr BsdfModelDescription kDescription{
      .name = "phong-1975",
      .label = "Phong shading (1975)",
      .model_class = ModelClass::phenomenological,
      .summary = "The historical shading of intensities, used as a BRDF.",
      .formula = "pi f cos_i = C (cos_i (1 - d) + d) + W <r, wi>^n",
      .properties = "Neither reciprocal nor energy conserving.",
      .sampling = "Cosine, uniform directions and cos^n for the three terms, each the exact shape of its term.",
      .limitations = "f grows as 1 / cos_i at grazing incidence.",
      .source = "[Phong 1975], [Lang, eq. 4.230]",
  };
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, InverseCosine<Color>, CosinePower<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 0.5f, {0, 1}, "C: diffuse reflection, multiplies the base colour"};
  Number<float> even{
      "even", "Ambient share", 0, {0, 1}, "d: the part of C that does not depend on the angle of incidence"};
  Number<float> weight{"weight", "Highlight", 0.3f, {0, 1}, "W: height of the highlight"};
  Number<float> exponent{"exponent", "Exponent",        5, {0, 1e5f}, "n: higher is glossier; 1 to 10 in 1975",
                         "",         Scale::logarithmic};
  auto parameters() { return std::tie(diffuse, even, weight, exponent); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    const Rgb c = base * diffuse;
    lobes.add(Lambert<Rgb>{c * (1 - even)});
    if (even > 0) {
      InverseCosine<Rgb> ambient;
      ambient.scale = c * (even * kInvPi);
      lobes.add(ambient);
    }
    CosinePower<Rgb> highlight;
    highlight.scale = Rgb(weight * kInvPi);
    highlight.exponent = exponent;
    highlight.over_cosine = true;
    highlight.albedo = 2 * weight / (exponent + 2);
    lobes.add(highlight);
  }
};

}  // namespace etendue
