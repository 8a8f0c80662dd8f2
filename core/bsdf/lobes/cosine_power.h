// A power of the cosine to the mirror direction, the lobe of the Phong models.                [Lang, sec. 4.2.2.5.2]
//
//   f = scale max(0, <r, wi>)^n [/ cos_i],         r the mirror direction of wo about the normal
//
// Sampled around r with density (n + 1) / (2 pi) <r, wi>^n. Samples below the surface are absorbed, up to one half at
// grazing angles. Negative cosines count as 0 [Lang, Remark 4.24].
#pragma once
#include "base/frame.h"
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/lobes/opaque_lobe.h"
#include "bsdf/microfacet/cosine_exponent.h"

namespace etendue {

template <class ColorType>
struct CosinePower : OpaqueLobe<ColorType, CosinePower<ColorType>> {
  ColorType scale{0};
  float exponent = 1;
  bool over_cosine = false;  // divide by cos_i
  float albedo = 0;          // estimate for lobe selection

  ColorType f(const Vec3& o, const Vec3& i) const {
    return scale * (power(cosine(o, i), exponent) / (over_cosine ? i.z : 1.0f));
  }
  float density(const Vec3& o, const Vec3& i) const {
    return (exponent + 1) / (2 * kPi) * power(cosine(o, i), exponent);
  }
  bool sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const {
    i = Frame(mirrored(o)).to_world(square_to_cosine_power(random.u, exponent));
    return true;
  }
  float sampling_weight(const Vec3&) const { return albedo; }
  float alpha() const { return alpha_of_exponent(exponent); }

 private:
  static Vec3 mirrored(const Vec3& w) { return {-w.x, -w.y, w.z}; }
  static float cosine(const Vec3& o, const Vec3& i) { return glm::dot(mirrored(o), i); }
};

// The parameters of the Phong BRDFs, and their lobes:
//
//   f = rho_d / pi + rho_s scale <r, wi>^n [/ cos_i]
struct PhongParameters {
  Number<float> diffuse{"diffuse", "Diffuse", 0.5f, {0, 1}, "Diffuse reflectance, multiplies the base colour"};
  Triple specular;
  Number<float> exponent{
      "exponent", "Exponent",        20, {0, 1e5f}, "Higher is glossier: 1 is matte, above 100 glossy",
      "",         Scale::logarithmic};

  explicit PhongParameters(const char* specular_doc)
      : specular{"specular", "Specular", Vec3(0.3f), {0, 1}, specular_doc} {}
  auto parameters() { return std::tie(diffuse, specular, exponent); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, float scale, bool over_cosine, LobeSet& lobes) const {
    lobes.add(Lambert<Rgb>{base * diffuse});
    CosinePower<Rgb> lobe;
    lobe.scale = rgb_of(specular) * scale;
    lobe.exponent = exponent;
    lobe.over_cosine = over_cosine;
    lobe.albedo = average(lobe.scale) * 2 * kPi / (exponent + 2);
    lobes.add(lobe);
  }
};

}  // namespace etendue
