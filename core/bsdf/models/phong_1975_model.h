// Phong's shading as he wrote it in 1975, for intensities and not for radiance.              thesis (4.228), item 51
//
//   S = C (cos_i (1 - d) + d) + W cos^n(theta_ro)          pi f cos_i = S of light of unit irradiance across the beam
//
// Neither reciprocal nor energy conserving: d lights what faces away from the light as much as what faces it, and W is
// added whatever the angle, so that f grows as 1 / cos_i. He gives 1 < n < 10, 0.1 < W < 0.8.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/cosine_power.h"
#include "bsdf/lobes/lambert.h"

namespace etendue {

// f = scale / cos_i, which reflects as much of a beam from any direction.
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
      "phong-1975", "Phong shading (1975)", ModelClass::phenomenological,
      "pi f cos_i = C (cos_i (1 - d) + d) + W cos^n: the historical shading of intensities. Neither reciprocal nor "
      "energy "
      "conserving.",
      "cosine, uniform directions and cos^n for its three terms, each its own lobe exactly"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, InverseCosine<Color>, CosinePower<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 0.5f, {0, 1}, "C, as a factor on the base colour"};
  Number<float> even{
      "even", "Even shade", 0, {0, 1}, "d: the part of C that does not depend on the angle of incidence"};
  Number<float> weight{"weight", "Highlight", 0.3f, {0, 1}, "W: the height of the highlight"};
  Number<float> exponent{"exponent", "Exponent", 5, {0, 1e5f}, "n, between 1 and 10 in 1975", "", Scale::logarithmic};
  auto parameters() { return std::tie(diffuse, even, weight, exponent); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    const Rgb c = base * diffuse;
    lobes.add(Lambert<Rgb>{c * (1 - even)});
    if (even > 0) {
      InverseCosine<Rgb> shade;
      shade.scale = c * (even * kInvPi);
      lobes.add(shade);
    }
    CosinePower<Rgb> lobe;
    lobe.scale = Rgb(weight * kInvPi), lobe.exponent = exponent, lobe.over_cosine = true;
    lobe.albedo = 2 * weight / (exponent + 2);
    lobes.add(lobe);
  }
};

}  // namespace etendue
