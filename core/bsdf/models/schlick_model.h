// Schlick's model.        "An Inexpensive BRDF Model for Physically-based Rendering", 1994; thesis item 66 (by name)
//
//   f = S(u) D                                                one layer
//   f = S(u) D + (1 - S(u)) S'(u) D'                          two,  S(u) = C + (1 - C)(1 - u)^5
//   D = a / pi + b B + c delta / cos,                         b = 4 r (1 - r), a = 1 - b above r = 0.5, c below
//   B = G G' Z A / (4 pi v v') + what self-shadowing took     Z = r / (1 + r t^2 - t^2)^2
//                                                             A = sqrt(p / (p^2 - p^2 w^2 + w^2)), G = v / (r - r v +
//                                                             v)
//
// with u = <o, h>, t = cos_h, v and v' the cosines of both directions, w the cosine of h's azimuth, r the roughness, p
// the isotropy. Reciprocal. Energy is gained at grazing angles, with any choice: a white layer reflects at 89.9 degrees
// up to 1.17 (r = 0.02) where self-shadowed light is lost, 1.57 (r = 0.3) where it comes back as (1 - G G') / pi, and
// without bound where it does as printed, as (1 - G G') / (4 pi v v'), or where there is no shadowing. A layer under
// another gets 1 - S(u) of the half angle, which is more than the upper one leaves. The mean of A is 1 for p = 1 and
// less below (0.74 for p = 0.1), so that brushed surfaces lose light.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/mirror.h"
#include "bsdf/lobes/opaque_lobe.h"
#include "bsdf/microfacet/half_vector.h"

namespace etendue {

enum class SchlickShadowing : uint8_t { none, lost, printed, diffuse };

// S(u), or where there is a layer above (1 - S_above(u)) S(u).
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

// a / pi + b B of a layer.
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
    const float cosine = cosine_share(o);
    if (!(half.cosine > 0)) return cosine * cosine_hemisphere_pdf(i.z);
    const Vec3& h = half.h;
    const float azimuth = azimuth_part(h, [&](float along2) { return std::sqrt(p) / (p + along2 * (1 - p)); });
    return cosine * cosine_hemisphere_pdf(i.z) + (1 - cosine) * zenith(h) * kInvPi * h.z * azimuth / (4 * half.cosine);
  }
  bool sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const {
    if (random.choice < cosine_share(o)) {
      i = random.cosine_direction;
      return true;
    }
    const float sin2 = r * (1 - random.u.x) / (r + random.u.x * (1 - r));
    const float turn = 2 * kPi * random.u.y;
    const Vec2 axis = glm::normalize(Vec2(std::sqrt(p) * std::cos(turn), std::sin(turn)));
    const Vec3 h(std::sqrt(sin2) * axis.x, std::sqrt(sin2) * axis.y, safe_sqrt(1 - sin2));
    i = reflect(o, h);
    return glm::dot(o, h) > 0;
  }
  float sampling_weight(const Vec3& wo) const { return (a + b) * average(spectrum(std::abs(wo.z))); }
  float alpha() const { return std::sqrt(r); }

 private:
  float open(float v) const { return v / (r - r * v + v); }

  float zenith(const Vec3& h) const { return r / sqr(sqr(h.x) + sqr(h.y) + r * sqr(h.z)); }
  // A function of the squared cosine of h's azimuth; h may be upright.
  template <class F>
  float azimuth_part(const Vec3& h, F&& of) const {
    const float planar = sqr(h.x) + sqr(h.y);
    return of(planar > 0 ? sqr(h.x) / planar : 1.0f);
  }

  float glossy(const Vec3& o, const Vec3& i, const Vec3& h) const {
    const float shape =
        zenith(h) * azimuth_part(h, [&](float w2) { return std::sqrt(p / (p * p + w2 * (1 - p * p))); });
    const float quarter = 0.25f * kInvPi;
    if (shadow == SchlickShadowing::none) return quarter * shape / (o.z * i.z);
    const float lobe = quarter * shape / ((r - r * o.z + o.z) * (r - r * i.z + i.z));
    const float taken = 1 - open(o.z) * open(i.z);
    if (shadow == SchlickShadowing::printed) return lobe + quarter * taken / (o.z * i.z);
    return shadow == SchlickShadowing::diffuse ? lobe + kInvPi * taken : lobe;
  }

  // How often the cosine is asked in place of the facets: for what is diffuse.
  float cosine_share(const Vec3& o) const {
    const bool returned = shadow == SchlickShadowing::printed || shadow == SchlickShadowing::diffuse;
    return (a + (returned ? b * std::max(0.1f, 1 - open(o.z)) : 0)) / (a + b);
  }
};

struct SchlickModel {
  static constexpr BsdfModelDescription kDescription{
      "schlick", "Schlick", ModelClass::phenomenological,
      "One or two layers of S(u) D: Schlick's Fresnel term times a rational lobe from mirror-like to diffuse (1994). "
      "Reciprocal; gains energy at grazing angles, least where self-shadowed light is lost.",
      "normals by Z with azimuths close to A, what leaves below the surface is absorbed; diffuse parts by the cosine"};
  template <class Color>
  using Lobes = std::tuple<SchlickLayer<Color>, Mirror<Color, SchlickSpectrum<Color>>>;

  Triple color{"color", "Reflectance", Vec3(0.05f), {0, 1}, "C: of the upper layer at normal incidence"};
  Number<float> r{"roughness", "Roughness", 0.1f, {0, 1}, "r: 0 is a mirror, 1 diffuse"};
  Number<float> p{"isotropy", "Isotropy", 1, {0.01f, 1}, "p: 1 is isotropic, below it is brushed along the tangent"};
  Toggle two{"double", "Two layers", true, "A second layer under the first, whose colour is the base colour"};
  Number<float> under_color{"under-color", "Lower reflectance", 0.6f, {0, 1}, "C', as a factor on the base colour"};
  Number<float> under_r{"under-roughness", "Lower roughness", 0.9f, {0, 1}, "r' of the lower layer"};
  Number<float> under_p{"under-isotropy", "Lower isotropy", 1, {0.01f, 1}, "p' of the lower layer"};
  Choice<SchlickShadowing> shadow{"shadowing", "Self-shadowing", SchlickShadowing::lost,
                                  "What becomes of light that facets keep from each other"};
  Toggle blend{"blend", "Mirror to diffuse", true, "Weights a, b, c by roughness; without them D is the lobe B alone"};
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
    constexpr float kLeast = 1e-6f;  // below it Z is narrower than directions are exact
    SchlickLayer<Rgb> layer;
    layer.spectrum = spectrum, layer.shadow = shadow, layer.r = std::max(rough, kLeast), layer.p = isotropy;
    layer.b = blend ? 4 * rough * (1 - rough) : 1.0f;
    if (rough < kLeast) layer.b = 0;
    layer.a = rough > 0.5f ? 1 - layer.b : 0;
    if (const float mirror = rough > 0.5f ? 0 : 1 - layer.b; mirror > 0)
      lobes.add(Mirror<Rgb, SchlickSpectrum<Rgb>>{{}, Rgb(mirror), spectrum});
    if (layer.a + layer.b > 0) lobes.add(layer);
  }
};

}  // namespace etendue

template <>
struct etendue::Options<etendue::SchlickShadowing> {
  static constexpr std::array<etendue::Option, 4> kOptions{{{"none", "None"},
                                                            {"lost", "Light is lost"},
                                                            {"printed", "Comes back as printed"},
                                                            {"diffuse", "Comes back diffusely"}}};
};
