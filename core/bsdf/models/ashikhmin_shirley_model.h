// The Ashikhmin-Shirley model, an anisotropic Phong model.                                [Ashikhmin and Shirley 2000]
//
//   f   = f_d + f_s
//   f_s = sqrt((nu + 1)(nv + 1)) / (8 pi) cos_h^((nu h_u^2 + nv h_v^2) / (1 - cos_h^2)) F(<o, h>)
//         / (<o, h> max(cos_o, cos_i)),                                          F = R_s + (1 - R_s)(1 - <o, h>)^5
//   f_d = 28 R_d / (23 pi) (1 - R_s)(1 - (1 - cos_i / 2)^5)(1 - (1 - cos_o / 2)^5)
//
//   Parameters   diffuse: R_d as a factor of the base colour; specular: R_s, the reflectance at normal incidence; nu,
//                nv: exponents along and across the tangent
//   Properties   Reciprocal. Conserves energy. R_d = 0.5, R_s = 0.05, nu = nv = 100 give the albedos 0.5082, 0.4940,
//                0.4315, 0.3950 at 0, 30, 60, 80 degrees.
//   Sampling     Half vectors by their power of the cosine; samples below the surface are absorbed. f_d by the
//                cosine.
//   Limitations  The albedo falls towards grazing angles.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/fresnel/fresnel.h"
#include "bsdf/lobes/opaque_lobe.h"
#include "bsdf/microfacet/half_vector.h"

namespace etendue {

// f_s
template <class ColorType>
struct AnisotropicPhong : OpaqueLobe<ColorType, AnisotropicPhong<ColorType>> {
  ColorType f0{0};  // R_s
  float nu = 100, nv = 100;

  ColorType f(const Vec3& o, const Vec3& i) const {
    const HalfVector half(o, i);
    if (!(half.cosine > 0)) return ColorType(0);
    return fresnel(half.cosine) * (0.25f * normal_density(half.h) / (half.cosine * std::max(o.z, i.z)));
  }
  float density(const Vec3& o, const Vec3& i) const {
    const HalfVector half(o, i);
    return half.cosine > 0 ? normal_density(half.h) / (4 * half.cosine) : 0;
  }
  bool sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const {
    const float phi = 2 * kPi * random.u.x;
    const float x = std::sqrt(nv + 1) * std::cos(phi), y = std::sqrt(nu + 1) * std::sin(phi);
    const float length2 = sqr(x) + sqr(y), n = (nu * sqr(x) + nv * sqr(y)) / length2;
    // 1 - (1 - u)^(2 / (n + 1)), accurate near 0.
    const float sin2 = -std::expm1(2 / (n + 1) * std::log1p(-random.u.y));
    const float sine = std::sqrt(sin2 / length2);
    const Vec3 h(sine * x, sine * y, safe_sqrt(1 - sin2));
    i = reflect(o, h);
    return glm::dot(o, h) > 0;
  }
  float sampling_weight(const Vec3& wo) const { return average(fresnel(std::abs(wo.z))); }
  float alpha() const { return std::min(1.0f, std::sqrt(2 / (std::min(nu, nv) + 2))); }

 private:
  ColorType fresnel(float cosine) const { return f0 + (ColorType(1) - f0) * schlick_weight(cosine); }

  // sqrt((nu + 1)(nv + 1)) / (2 pi) cos_h^n, the density of half vectors per solid angle.
  float normal_density(const Vec3& h) const {
    const float x2 = sqr(h.x), y2 = sqr(h.y), sin2 = std::min(x2 + y2, 1.0f);
    if (sin2 == 1) return nu == 0 && nv == 0 ? 0.5f * kInvPi : 0;
    const float n = sin2 > 0 ? (nu * x2 + nv * y2) / (x2 + y2) : 0;
    return std::sqrt((nu + 1) * (nv + 1)) * 0.5f * kInvPi * std::exp(0.5f * n * std::log1p(-sin2));
  }
};

// f_d
template <class ColorType>
struct CoupledDiffuse : OpaqueLobe<ColorType, CoupledDiffuse<ColorType>, ScatterType::diffuse> {
  ColorType scale{0};  // R_d (1 - R_s)

  ColorType f(const Vec3& o, const Vec3& i) const {
    return scale * (28 / (23 * kPi) * (transmitted(o) * transmitted(i)));
  }
  float density(const Vec3&, const Vec3& i) const { return cosine_hemisphere_pdf(i.z); }
  bool sample_direction(const Vec3&, const LobeRandom& random, Vec3& i) const {
    i = random.cosine_direction;
    return true;
  }
  float sampling_weight(const Vec3& wo) const { return average(scale) * transmitted(wo); }
  float alpha() const { return 1; }

 private:
  static float transmitted(const Vec3& w) { return 1 - schlick_weight(0.5f * std::abs(w.z)); }
};

struct AshikhminShirleyModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "ashikhmin-shirley",
      .label = "Ashikhmin-Shirley",
      .model_class = ModelClass::phenomenological,
      .summary =
          "An anisotropic Phong lobe with Schlick's Fresnel term, over a diffuse term that receives the light the lobe "
          "does not reflect.",
      .formula =
          "f_s = sqrt((nu + 1)(nv + 1)) / (8 pi) cos_h^((nu h_u^2 + nv h_v^2) / (1 - cos_h^2)) F(<o, h>) "
          "/ (<o, h> max(cos_o, cos_i))\n"
          "f_d = 28 R_d / (23 pi) (1 - R_s)(1 - (1 - cos_i / 2)^5)(1 - (1 - cos_o / 2)^5)",
      .properties = "Reciprocal. Conserves energy.",
      .sampling =
          "Half vectors by their power of the cosine; samples below the surface are absorbed. The diffuse term by "
          "the cosine.",
      .limitations = "The albedo falls towards grazing angles.",
      .source = "[Ashikhmin and Shirley 2000]",
  };
  template <class Color>
  using Lobes = std::tuple<CoupledDiffuse<Color>, AnisotropicPhong<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 0.5f, {0, 1}, "Diffuse reflectance, multiplies the base colour"};
  Triple specular{"specular", "Specular", Vec3(0.05f), {0, 1}, "Reflectance at normal incidence"};
  Number<float> nu{"nu", "Exponent u",      100, {0, 1e5f}, "Exponent along the tangent; higher is narrower",
                   "",   Scale::logarithmic};
  Number<float> nv{"nv", "Exponent v",      100, {0, 1e5f}, "Exponent across the tangent; higher is narrower",
                   "",   Scale::logarithmic};
  auto parameters() { return std::tie(diffuse, specular, nu, nv); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    const Rgb f0 = rgb_of(specular);
    CoupledDiffuse<Rgb> diffuse_lobe;
    diffuse_lobe.scale = base * diffuse * (Rgb(1) - f0);
    lobes.add(diffuse_lobe);
    AnisotropicPhong<Rgb> specular_lobe;
    specular_lobe.f0 = f0;
    specular_lobe.nu = nu;
    specular_lobe.nv = nv;
    lobes.add(specular_lobe);
  }
};

}  // namespace etendue
