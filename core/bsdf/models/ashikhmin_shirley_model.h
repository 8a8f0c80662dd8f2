// Ashikhmin and Shirley's anisotropic Phong model.       Journal of Graphics Tools 5(2), 2000; thesis item 66 (by name)
//
//   f_s = sqrt((nu + 1)(nv + 1)) / (8 pi) cos_h^((nu h_u^2 + nv h_v^2) / (1 - cos_h^2)) F(<o, h>)
//         / (<o, h> max(cos_o, cos_i)),                                           F = R_s + (1 - R_s)(1 - <o, h>)^5
//   f_d = 28 R_d / (23 pi) (1 - R_s)(1 - (1 - cos_i / 2)^5)(1 - (1 - cos_o / 2)^5)
//
// Reciprocal. The diffuse part takes what Fresnel's term leaves: R_d = 0.5, R_s = 0.05, nu = nv = 100 reflect 0.5082,
// 0.4940, 0.4315, 0.3950 at 0, 30, 60, 80 degrees. Never more than it gets.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/fresnel/fresnel.h"
#include "bsdf/lobes/opaque_lobe.h"
#include "bsdf/microfacet/half_vector.h"

namespace etendue {

template <class ColorType>
struct AnisotropicPhong : OpaqueLobe<ColorType, AnisotropicPhong<ColorType>> {
  ColorType f0{0};
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
    const float turn = 2 * kPi * random.u.x;
    const float x = std::sqrt(nv + 1) * std::cos(turn), y = std::sqrt(nu + 1) * std::sin(turn);
    const float length2 = sqr(x) + sqr(y), n = (nu * sqr(x) + nv * sqr(y)) / length2;
    // 1 - (1 - u)^(2 / (n + 1)), without losing the digits of what is next to 0.
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

  // sqrt((nu + 1)(nv + 1)) / (2 pi) cos^n, the density of normals.
  float normal_density(const Vec3& h) const {
    const float x2 = sqr(h.x), y2 = sqr(h.y), sin2 = std::min(x2 + y2, 1.0f);
    if (sin2 == 1) return nu == 0 && nv == 0 ? 0.5f * kInvPi : 0;
    const float n = sin2 > 0 ? (nu * x2 + nv * y2) / (x2 + y2) : 0;
    return std::sqrt((nu + 1) * (nv + 1)) * 0.5f * kInvPi * std::exp(0.5f * n * std::log1p(-sin2));
  }
};

template <class ColorType>
struct CoupledDiffuse : OpaqueLobe<ColorType, CoupledDiffuse<ColorType>, ScatterType::diffuse> {
  ColorType scale{0};  // R_d (1 - R_s)

  ColorType f(const Vec3& o, const Vec3& i) const { return scale * (28 / (23 * kPi) * (passed(o) * passed(i))); }
  float density(const Vec3&, const Vec3& i) const { return cosine_hemisphere_pdf(i.z); }
  bool sample_direction(const Vec3&, const LobeRandom& random, Vec3& i) const {
    i = random.cosine_direction;
    return true;
  }
  float sampling_weight(const Vec3& wo) const { return average(scale) * passed(wo); }
  float alpha() const { return 1; }

 private:
  static float passed(const Vec3& w) { return 1 - schlick_weight(0.5f * std::abs(w.z)); }
};

struct AshikhminShirleyModel {
  static constexpr BsdfModelDescription kDescription{
      "ashikhmin-shirley", "Ashikhmin-Shirley", ModelClass::phenomenological,
      "An anisotropic Phong lobe about the half vector with Schlick's Fresnel term, and a diffuse part that gets what "
      "it leaves (2000). Reciprocal; conserves energy.",
      "normals by their power of the cosine, what leaves below the surface is absorbed; the diffuse part by the "
      "cosine"};
  template <class Color>
  using Lobes = std::tuple<CoupledDiffuse<Color>, AnisotropicPhong<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 0.5f, {0, 1}, "R_d, as a factor on the base colour"};
  Triple specular{"specular", "Specular", Vec3(0.05f), {0, 1}, "R_s: reflectance at normal incidence"};
  Number<float> nu{"nu", "Exponent along",  100, {0, 1e5f}, "n along the tangent; higher is narrower",
                   "",   Scale::logarithmic};
  Number<float> nv{"nv", "Exponent across", 100, {0, 1e5f}, "n across the tangent; higher is narrower",
                   "",   Scale::logarithmic};
  auto parameters() { return std::tie(diffuse, specular, nu, nv); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    const Rgb f0 = rgb_of(specular);
    CoupledDiffuse<Rgb> under;
    under.scale = base * diffuse * (Rgb(1) - f0);
    lobes.add(under);
    AnisotropicPhong<Rgb> gloss;
    gloss.f0 = f0, gloss.nu = nu, gloss.nv = nv;
    lobes.add(gloss);
  }
};

}  // namespace etendue
