// Lafortune's generalised cosine lobes.                                                       [Lafortune et al. 1997]
//
//   f = rho_d / pi + sum rho_j max(0, Cx o_x i_x + Cy o_y i_y + Cz o_z i_z)^n
//
// (Cx, Cy, Cz) = (-1, -1, 1) is Phong's lobe about the mirror direction, (1, 1, 1) a retroreflector, a Cz larger in
// size than the others an off-specular lobe, Cx = Cy = 0 a power of both cosines.
//
//   Parameters   diffuse: rho_d as a factor of the base colour; for each of three lobes scale: rho_j in 1/sr, cx, cy,
//                cz: coefficients along the tangent, across it and along the normal, n: exponent. Coefficients are at
//                most 1 in size; a fit with larger ones has the remaining factor, to the power n, in rho_j.
//   Properties   Reciprocal. Not normalised: a lobe of Phong's kind conserves energy for rho_j <= (n + 2) / (2 pi).
//   Sampling     cos^n about the axis (Cx o_x, Cy o_y, Cz o_z) of each lobe; samples below the surface are absorbed.
//   Limitations  Energy conservation depends on the coefficients.
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
  Vec3 c{-1, -1, 1};  // Cx, Cy, Cz
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
  // The albedo of cos^n is about 2 pi / (n + 2); |c wo|^n is the height of the lobe along its axis.
  float sampling_weight(const Vec3& wo) const {
    return average(scale) * power(glm::length(c * wo), exponent) * 2 * kPi / (exponent + 2);
  }
  float alpha() const { return alpha_of_exponent(exponent); }

 private:
  Vec3 axis(const Vec3& o) const { return normalize_or(c * o, Vec3(0, 0, 1)); }
};

// The parameters of one lobe.
struct GeneralisedCosineParameters {
  Triple scale;
  Number<float> x, y, z, exponent;

  auto parameters() { return std::tie(scale, x, y, z, exponent); }
  bool enabled() const { return scale.value != Vec3(0); }
  GeneralisedCosine<Rgb> lobe() const {
    GeneralisedCosine<Rgb> lobe;
    lobe.scale = rgb_of(scale);
    lobe.c = Vec3(x, y, z);
    lobe.exponent = exponent;
    return lobe;
  }
};

struct LafortuneModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "lafortune",
      .label = "Lafortune",
      .model_class = ModelClass::phenomenological,
      .summary = "A diffuse term and up to three generalised cosine lobes: specular, off-specular or retroreflecting.",
      .formula = "f = rho_d / pi + sum rho_j max(0, Cx o_x i_x + Cy o_y i_y + Cz o_z i_z)^n",
      .properties = "Reciprocal. Energy conservation depends on the coefficients.",
      .sampling = "cos^n about the axis (Cx o_x, Cy o_y, Cz o_z) of each lobe; samples below the surface are absorbed.",
      .limitations = "The lobes are not normalised.",
      .source = "[Lafortune et al. 1997]",
  };
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, GeneralisedCosine<Color>>;

  static constexpr const char* kScaleDoc = "Height of the lobe, 1/sr; 0 turns it off";
  static constexpr const char* kCoefficientDoc =
      "Coefficient along the tangent (x), across it (y) or along the normal (z)";
  static constexpr const char* kExponentDoc = "Higher is narrower: 1 is wide, above 100 narrow";

  Number<float> diffuse{"diffuse", "Diffuse", 0.3f, {0, 1}, "Diffuse reflectance, multiplies the base colour"};
  GeneralisedCosineParameters first{{"scale-1", "Scale 1", Vec3(1), {0, 100}, kScaleDoc},
                                    {"cx-1", "Cx 1", -1, {-1, 1}, kCoefficientDoc},
                                    {"cy-1", "Cy 1", -1, {-1, 1}, kCoefficientDoc},
                                    {"cz-1", "Cz 1", 0.95f, {-1, 1}, kCoefficientDoc},
                                    {"n-1", "Exponent 1", 20, {0, 1e4f}, kExponentDoc, "", Scale::logarithmic}};
  GeneralisedCosineParameters second{{"scale-2", "Scale 2", Vec3(0.2f), {0, 100}, kScaleDoc},
                                     {"cx-2", "Cx 2", 0.8f, {-1, 1}, kCoefficientDoc},
                                     {"cy-2", "Cy 2", 0.8f, {-1, 1}, kCoefficientDoc},
                                     {"cz-2", "Cz 2", 0.9f, {-1, 1}, kCoefficientDoc},
                                     {"n-2", "Exponent 2", 5, {0, 1e4f}, kExponentDoc, "", Scale::logarithmic}};
  GeneralisedCosineParameters third{{"scale-3", "Scale 3", Vec3(0), {0, 100}, kScaleDoc},
                                    {"cx-3", "Cx 3", 0, {-1, 1}, kCoefficientDoc},
                                    {"cy-3", "Cy 3", 0, {-1, 1}, kCoefficientDoc},
                                    {"cz-3", "Cz 3", 1, {-1, 1}, kCoefficientDoc},
                                    {"n-3", "Exponent 3", 1, {0, 1e4f}, kExponentDoc, "", Scale::logarithmic}};
  auto parameters() {
    return std::tuple_cat(std::tie(diffuse), first.parameters(), second.parameters(), third.parameters());
  }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    lobes.add(Lambert<Rgb>{base * diffuse});
    for (const GeneralisedCosineParameters* parameters : {&first, &second, &third})
      if (parameters->enabled()) lobes.add(parameters->lobe());
  }
};

}  // namespace etendue
