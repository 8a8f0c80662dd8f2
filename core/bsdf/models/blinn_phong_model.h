// Blinn's half vector in Phong's model.                                                 thesis (4.240), item 56, E16
//
//   f = rho_d / pi + rho_s <N, H>^n / cos_i
//
// The half vector is a unit vector. Neither reciprocal nor energy conserving; without the cosine, as thesis L9442 has
// it too, it is reciprocal. The lobe is as wide as Phong's with a quarter of the exponent.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/lobes/opaque_lobe.h"
#include "bsdf/microfacet/cosine_exponent.h"
#include "bsdf/microfacet/half_vector.h"

namespace etendue {

template <class ColorType>
struct HalfVectorPower : OpaqueLobe<ColorType, HalfVectorPower<ColorType>> {
  ColorType scale{0};
  float exponent = 1;
  bool over_cosine = true;  // divided by the cosine of the incident direction

  ColorType f(const Vec3& o, const Vec3& i) const {
    return scale * (power(half_vector(o, i).z, exponent) / (over_cosine ? i.z : 1.0f));
  }
  float density(const Vec3& o, const Vec3& i) const {
    const Vec3 h = half_vector(o, i);
    return (exponent + 1) / (2 * kPi) * power(h.z, exponent) * half_vector_jacobian(o, h);
  }
  bool sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const {
    const Vec3 h = square_to_cosine_power(random.u, exponent);
    i = reflect(o, h);
    return glm::dot(o, h) > 0;
  }
  float sampling_weight(const Vec3&) const { return average(scale) * 8 * kPi / (exponent + 4); }
  float alpha() const { return alpha_of_exponent(exponent / 4); }
};

struct BlinnPhongModel {
  static constexpr BsdfModelDescription kDescription{
      "blinn-phong", "Blinn-Phong", ModelClass::phenomenological,
      "f = rho_d/pi + rho_s <N,H>^n / cos_i with the unit half vector H. Neither reciprocal nor energy conserving; "
      "without "
      "the cosine it is reciprocal.",
      "half vectors by cos^n; what is reflected below the surface is absorbed"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, HalfVectorPower<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 0.5f, {0, 1}, "rho_d, as a factor on the base colour"};
  Triple specular{"specular", "Specular", Vec3(0.3f), {0, 1}, "rho_s: the height of the lobe, in 1/sr"};
  Number<float> exponent{"exponent", "Exponent",        80, {0, 1e5f}, "n: four times Phong's for as wide a highlight",
                         "",         Scale::logarithmic};
  Toggle over_cosine{"over-cosine", "Over the cosine", true, "Divide by the cosine of incidence, as Phong's BRDF does"};
  auto parameters() { return std::tie(diffuse, specular, exponent, over_cosine); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    lobes.add(Lambert<Rgb>{base * diffuse});
    HalfVectorPower<Rgb> lobe;
    lobe.scale = rgb_of(specular), lobe.exponent = exponent, lobe.over_cosine = over_cosine;
    lobes.add(lobe);
  }
};

}  // namespace etendue
