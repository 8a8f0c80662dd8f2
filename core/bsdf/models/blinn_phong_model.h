// The Blinn-Phong model, a power of the cosine between half vector and normal.
//                                                                  [Blinn 1977; Lang, eq. 4.243-4.245, corrected]
//   f = rho_d / pi + rho_s cos_h^n / cos_i
//
// The half vector is normalised.
//
//   Parameters   diffuse: rho_d as a factor of the base colour; specular: rho_s in 1/sr; exponent: n; over-cosine:
//                divide by cos_i. The highlight is as wide as that of Phong's model with n / 4.
//   Properties   Neither reciprocal nor energy conserving. Without the division by cos_i it is reciprocal.
//   Sampling     Half vectors by cos^n; samples below the surface are absorbed.
//   Limitations  The lobe is not normalised.
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
  bool over_cosine = true;  // divide by cos_i

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
      .name = "blinn-phong",
      .label = "Blinn-Phong",
      .model_class = ModelClass::phenomenological,
      .summary = "A diffuse term and a power of the cosine between half vector and normal.",
      .formula = "f = rho_d / pi + rho_s cos_h^n / cos_i",
      .properties = "Neither reciprocal nor energy conserving. Reciprocal without the division by cos_i.",
      .sampling = "Half vectors by cos^n; samples below the surface are absorbed.",
      .limitations = "The specular lobe is not normalised.",
      .source = "[Blinn 1977], [Lang, eq. 4.243-4.245, corrected]",
  };
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, HalfVectorPower<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 0.5f, {0, 1}, "Diffuse reflectance, multiplies the base colour"};
  Triple specular{"specular", "Specular", Vec3(0.3f), {0, 1}, "Height of the highlight, 1/sr"};
  Number<float> exponent{"exponent",
                         "Exponent",
                         80,
                         {0, 1e5f},
                         "Higher is glossier; four times Phong's exponent for the same width",
                         "",
                         Scale::logarithmic};
  Toggle over_cosine{"over-cosine", "Divide by cosine", true,
                     "Divide by the cosine of incidence, as Phong's BRDF does; off makes the model reciprocal"};
  auto parameters() { return std::tie(diffuse, specular, exponent, over_cosine); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    lobes.add(Lambert<Rgb>{base * diffuse});
    HalfVectorPower<Rgb> lobe;
    lobe.scale = rgb_of(specular);
    lobe.exponent = exponent;
    lobe.over_cosine = over_cosine;
    lobes.add(lobe);
  }
};

}  // namespace etendue
