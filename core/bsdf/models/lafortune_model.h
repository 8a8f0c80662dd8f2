// Lafortune's generalised cosine lobes.               Lafortune, Foo, Torrance, Greenberg 1997; thesis item 66 (by
// name)
//
//   f = rho_d / pi + sum rho_j max(0, Cx o_x i_x + Cy o_y i_y + Cz o_z i_z)^n
//
// (-1, -1, 1) is Phong's lobe about the mirrored direction, (1, 1, 1) a retroreflector, a Cz above the others is
// off-specular, Cx = Cy = 0 a power of both cosines. Coefficients are at most 1 in size: a fit with larger ones has the
// rest, to the power of n, in rho_j. Reciprocal. Not normalised: a lobe of Phong's kind conserves energy where rho_j is
// at most (n + 2) / (2 pi), as the modified Phong model has it.
#pragma once
#include "base/frame.h"
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/lobes/opaque_lobe.h"
#include "bsdf/microfacet/cosine_exponent.h"

namespace etendue {

template <class ColorType>
struct GeneralisedCosine : OpaqueLobe<ColorType, GeneralisedCosine<ColorType>> {
  ColorType scale{0};
  Vec3 c{-1, -1, 1};
  float exponent = 1;

  ColorType f(const Vec3& o, const Vec3& i) const {
    return scale * power(c.x * (o.x * i.x) + c.y * (o.y * i.y) + c.z * (o.z * i.z), exponent);
  }
  float density(const Vec3& o, const Vec3& i) const {
    return (exponent + 1) / (2 * kPi) * power(glm::dot(axis(o), i), exponent);
  }
  bool sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const {
    i = Frame(axis(o)).to_world(square_to_cosine_power(random.u, exponent));
    return true;
  }
  // About 2 pi / (n + 2) cos^n of its strength towards the axis.
  float sampling_weight(const Vec3& wo) const {
    return average(scale) * power(glm::length(c * wo), exponent) * 2 * kPi / (exponent + 2);
  }
  float alpha() const { return alpha_of_exponent(exponent); }

 private:
  Vec3 axis(const Vec3& o) const { return normalize_or(c * o, Vec3(0, 0, 1)); }
};

// The knobs of one lobe; names are whole, so that they can be compared as they stand.
struct GeneralisedCosineParameters {
  Triple scale;
  Number<float> x, y, z, exponent;

  auto parameters() { return std::tie(scale, x, y, z, exponent); }
  bool any() const { return scale.value != Vec3(0); }
  GeneralisedCosine<Rgb> lobe() const {
    GeneralisedCosine<Rgb> lobe;
    lobe.scale = rgb_of(scale), lobe.c = Vec3(x, y, z), lobe.exponent = exponent;
    return lobe;
  }
};

struct LafortuneModel {
  static constexpr BsdfModelDescription kDescription{
      "lafortune", "Lafortune", ModelClass::phenomenological,
      "f = rho_d/pi + sum rho_j (Cx o_x i_x + Cy o_y i_y + Cz o_z i_z)^n: up to three lobes, mirror-like, off-specular "
      "or "
      "retroreflecting (1997). Reciprocal; energy is up to the coefficients.",
      "by cos^n about each lobe's own axis (Cx o_x, Cy o_y, Cz o_z); what falls below the surface is absorbed"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, GeneralisedCosine<Color>>;

  static constexpr const char* kScaleDoc = "rho_j: the height of the lobe, in 1/sr";
  static constexpr const char* kCDoc = "Coefficient of the products along the tangent, across it, along the normal";
  static constexpr const char* kExponentDoc = "n: 1 is wide, above 100 narrow";

  Number<float> diffuse{"diffuse", "Diffuse", 0.3f, {0, 1}, "rho_d, as a factor on the base colour"};
  GeneralisedCosineParameters first{{"scale-1", "Scale 1", Vec3(1), {0, 100}, kScaleDoc},
                                    {"cx-1", "Cx 1", -1, {-1, 1}, kCDoc},
                                    {"cy-1", "Cy 1", -1, {-1, 1}, kCDoc},
                                    {"cz-1", "Cz 1", 0.95f, {-1, 1}, kCDoc},
                                    {"n-1", "Exponent 1", 20, {0, 1e4f}, kExponentDoc, "", Scale::logarithmic}};
  GeneralisedCosineParameters second{{"scale-2", "Scale 2", Vec3(0.2f), {0, 100}, kScaleDoc},
                                     {"cx-2", "Cx 2", 0.8f, {-1, 1}, kCDoc},
                                     {"cy-2", "Cy 2", 0.8f, {-1, 1}, kCDoc},
                                     {"cz-2", "Cz 2", 0.9f, {-1, 1}, kCDoc},
                                     {"n-2", "Exponent 2", 5, {0, 1e4f}, kExponentDoc, "", Scale::logarithmic}};
  GeneralisedCosineParameters third{{"scale-3", "Scale 3", Vec3(0), {0, 100}, kScaleDoc},
                                    {"cx-3", "Cx 3", 0, {-1, 1}, kCDoc},
                                    {"cy-3", "Cy 3", 0, {-1, 1}, kCDoc},
                                    {"cz-3", "Cz 3", 1, {-1, 1}, kCDoc},
                                    {"n-3", "Exponent 3", 1, {0, 1e4f}, kExponentDoc, "", Scale::logarithmic}};
  auto parameters() {
    return std::tuple_cat(std::tie(diffuse), first.parameters(), second.parameters(), third.parameters());
  }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    lobes.add(Lambert<Rgb>{base * diffuse});
    for (const GeneralisedCosineParameters* knobs : {&first, &second, &third})
      if (knobs->any()) lobes.add(knobs->lobe());
  }
};

}  // namespace etendue
