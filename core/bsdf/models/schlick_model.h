// Schlick's model: rational functions in place of powers and exponentials.                            [Schlick 1994]
//
//   f = S(u) D                                                one layer
//   f = S(u) D + (1 - S(u)) S'(u) D'                          two layers,  S(u) = C + (1 - C)(1 - u)^5
//   D = a / pi + b B + c delta / cos,                         b = 4 r (1 - r); 1 - b is a above r = 0.5, c below
//   B = G G' Z A / (4 pi v v') + returned                     Z = r / (1 + r t^2 - t^2)^2
//                                                             A = sqrt(p / (p^2 - p^2 w^2 + w^2))
//                                                             G = v / (r - r v + v)
//
// u = <o, h>, t = cos_h, v and v' are the cosines of both directions, w is the cosine of the azimuth of h, r the
// roughness, p the isotropy. `returned` is the light that self-shadowing takes, if it is returned at all.
//
//   Parameters   color, roughness, isotropy: C, r, p of the upper layer; double: whether a lower layer exists;
//                under-color: C' as a factor of the base colour; under-roughness, under-isotropy: r', p'; shadowing:
//                what happens to self-shadowed light; blend: use a, b, c, or the lobe B alone
//   Properties   Reciprocal. Gains energy at grazing angles with every choice. A white layer has at 89.9 degrees an
//                albedo of 1.17 (r = 0.02) if self-shadowed light is lost, and 1.57 (r = 0.3) if it returns as (1 - G
//                G') / pi. The albedo has no bound if it returns as printed, as (1 - G G') / (4 pi v v'), or without
//                shadowing.
//   Sampling     Normals by Z with azimuths close to A, diffuse parts by the cosine; samples below the surface are
//                absorbed.
//   Limitations  The lower layer receives 1 - S(u) at the half angle, more than the upper layer transmits. The mean
//                of A is 1 for p = 1 and smaller below (0.74 for p = 0.1), so brushed surfaces lose light.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/mirror.h"
#include "bsdf/lobes/opaque_lobe.h"
#include "bsdf/microfacet/half_vector.h"

namespace etendue {

// What happens to light that the microfacets shadow: there is no shadowing; it is lost; it returns as printed, with the
// density (1 - G G') / (4 pi v v'); it returns diffusely, as (1 - G G') / pi.
enum class SchlickShadowing : uint8_t { none, lost, printed, diffuse };

// S(u) of a layer; (1 - S_above(u)) S(u) if another layer covers it.
template <class Color>
struct SchlickSpectrum {
  Color own{0}, above{0};
  bool covered = false;

  Color operator()(float u) const {
    const float w = schlick_weight(u);
    const Color s = own + (Color(1) - own) * w;
    return covered ? (Color(1) - above) * (1 - w) * s : s;
  }
};

// S(u) (a / pi + b B) of a layer.
template <class ColorType>
struct SchlickLayer : OpaqueLobe<ColorType, SchlickLayer<ColorType>> {
  SchlickSpectrum<ColorType> spectrum;
  float a = 0, b = 1, r = 0.3f, p = 1;
  SchlickShadowing shadow = SchlickShadowing::diffuse;

  ColorType f(const Vec3& o, const Vec3& i) const {
    const HalfVector half(o, i);
    return spectrum(half.cosine) * (a * kInvPi + b * glossy(o, i, half.h));
  }
  float density(const Vec3& o, const Vec3& i) const {
    const HalfVector half(o, i);
    const float cosine = cosine_probability(o);
    if (!(half.cosine > 0)) return cosine * cosine_hemisphere_pdf(i.z);
    const Vec3& h = half.h;
    const float azimuth = azimuth_part(h, [&](float along2) { return std::sqrt(p) / (p + along2 * (1 - p)); });
    return cosine * cosine_hemisphere_pdf(i.z) + (1 - cosine) * zenith(h) * kInvPi * h.z * azimuth / (4 * half.cosine);
  }
  bool sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const {
    if (random.choice < cosine_probability(o)) {
      i = random.cosine_direction;
      return true;
    }
    const float sin2 = r * (1 - random.u.x) / (r + random.u.x * (1 - r));
    const float phi = 2 * kPi * random.u.y;
    const Vec2 axis = glm::normalize(Vec2(std::sqrt(p) * std::cos(phi), std::sin(phi)));
    const Vec3 h(std::sqrt(sin2) * axis.x, std::sqrt(sin2) * axis.y, safe_sqrt(1 - sin2));
    i = reflect(o, h);
    return glm::dot(o, h) > 0;
  }
  float sampling_weight(const Vec3& wo) const { return (a + b) * average(spectrum(std::abs(wo.z))); }
  float alpha() const { return std::sqrt(r); }

 private:
  // G
  float visibility(float v) const { return v / (r - r * v + v); }

  // Z
  float zenith(const Vec3& h) const { return r / sqr(sqr(h.x) + sqr(h.y) + r * sqr(h.z)); }
  // A function of w^2, the squared cosine of the azimuth of h; 1 if h is the normal.
  template <class F>
  float azimuth_part(const Vec3& h, F&& of) const {
    const float planar = sqr(h.x) + sqr(h.y);
    return of(planar > 0 ? sqr(h.x) / planar : 1.0f);
  }

  // B
  float glossy(const Vec3& o, const Vec3& i, const Vec3& h) const {
    const float shape =
        zenith(h) * azimuth_part(h, [&](float w2) { return std::sqrt(p / (p * p + w2 * (1 - p * p))); });
    const float quarter = 0.25f * kInvPi;
    if (shadow == SchlickShadowing::none) return quarter * shape / (o.z * i.z);
    const float lobe = quarter * shape / ((r - r * o.z + o.z) * (r - r * i.z + i.z));
    const float shadowed = 1 - visibility(o.z) * visibility(i.z);
    if (shadow == SchlickShadowing::printed) return lobe + quarter * shadowed / (o.z * i.z);
    return shadow == SchlickShadowing::diffuse ? lobe + kInvPi * shadowed : lobe;
  }

  // The probability of sampling by the cosine instead of by Z, for the diffuse parts.
  float cosine_probability(const Vec3& o) const {
    const bool returned = shadow == SchlickShadowing::printed || shadow == SchlickShadowing::diffuse;
    return (a + (returned ? b * std::max(0.1f, 1 - visibility(o.z)) : 0)) / (a + b);
  }
};

struct SchlickModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "schlick",
      .label = "Schlick",
      .model_class = ModelClass::phenomenological,
      .summary =
          "One or two layers of Schlick's Fresnel term times a rational lobe, from mirror to diffuse, isotropic or "
          "brushed.",
      .formula =
          "f = S(u) D + (1 - S(u)) S'(u) D',  S(u) = C + (1 - C)(1 - u)^5\n"
          "D = a / pi + b B + c delta / cos,  B = G G' Z A / (4 pi v v') + returned light",
      .properties = "Reciprocal. Gains energy at grazing angles, least if self-shadowed light is lost.",
      .sampling =
          "Normals by Z with azimuths close to A, diffuse parts by the cosine; samples below the surface are "
          "absorbed.",
      .limitations = "The lower layer receives more light than the upper one transmits; brushed surfaces lose light.",
      .source = "[Schlick 1994]",
  };
  template <class Color>
  using Lobes = std::tuple<SchlickLayer<Color>, Mirror<Color, SchlickSpectrum<Color>>>;

  Triple color{"color", "Reflectance", Vec3(0.05f), {0, 1}, "Reflectance of the upper layer at normal incidence"};
  Number<float> r{"roughness", "Roughness", 0.1f, {0, 1}, "0 is a mirror, 1 diffuse"};
  Number<float> p{"isotropy", "Isotropy", 1, {0.01f, 1}, "1 is isotropic; lower is brushed along the tangent"};
  Toggle two{"double", "Two layers", true, "Adds a lower layer with the base colour"};
  Number<float> under_color{
      "under-color", "Lower reflectance", 0.6f, {0, 1}, "Reflectance of the lower layer, multiplies the base colour"};
  Number<float> under_r{"under-roughness", "Lower roughness", 0.9f, {0, 1}, "Roughness of the lower layer"};
  Number<float> under_p{"under-isotropy", "Lower isotropy", 1, {0.01f, 1}, "Isotropy of the lower layer"};
  Choice<SchlickShadowing> shadow{"shadowing", "Self-shadowing", SchlickShadowing::lost,
                                  "What happens to light that microfacets shadow"};
  Toggle blend{"blend", "Mirror to diffuse", true,
               "Blend diffuse, glossy and specular reflection by roughness; off uses the glossy lobe alone"};
  auto parameters() { return std::tie(color, r, p, two, under_color, under_r, under_p, shadow, blend); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    const Rgb above = rgb_of(color);
    add_layer({above, Rgb(0), false}, r, p, lobes);
    if (two) add_layer({base * under_color, above, true}, under_r, under_p, lobes);
  }

 private:
  template <class LobeSet>
  void add_layer(const SchlickSpectrum<Rgb>& spectrum, float rough, float isotropy, LobeSet& lobes) const {
    constexpr float kMinRoughness = 1e-6f;  // float directions do not resolve a narrower Z
    SchlickLayer<Rgb> layer;
    layer.spectrum = spectrum;
    layer.shadow = shadow;
    layer.r = std::max(rough, kMinRoughness);
    layer.p = isotropy;
    layer.b = blend ? 4 * rough * (1 - rough) : 1.0f;
    if (rough < kMinRoughness) layer.b = 0;
    layer.a = rough > 0.5f ? 1 - layer.b : 0;
    if (const float mirror = rough > 0.5f ? 0 : 1 - layer.b; mirror > 0)
      lobes.add(Mirror<Rgb, SchlickSpectrum<Rgb>>{{}, Rgb(mirror), spectrum});
    if (layer.a + layer.b > 0) lobes.add(layer);
  }
};

}  // namespace etendue

template <>
struct etendue::Options<etendue::SchlickShadowing> {
  static constexpr std::array<etendue::Option, 4> kOptions{
      {{"none", "None"}, {"lost", "Lost"}, {"printed", "Returned (as published)"}, {"diffuse", "Returned diffusely"}}};
};
