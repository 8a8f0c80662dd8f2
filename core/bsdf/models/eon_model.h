// Energy-preserving Oren-Nayar (EON).                                                         [Portsmouth et al. 2025]
//
//   f = f_ss + f_ms,       see lobes/eon.h
//
//   Parameters   diffuse: a factor of the base colour, rho is their product; roughness: r, 0 is Lambert's model
//   Properties   Reciprocal. Conserves energy: the albedo is 1 for rho = 1, for every roughness and angle.
//   Sampling     A clipped linearly transformed cosine, mixed with uniform directions.
//   Limitations  None known.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/eon.h"

namespace etendue {

struct EonModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "eon",
      .label = "Oren-Nayar, energy-preserving (EON)",
      .model_class = ModelClass::physical,
      .summary = "Rough diffuse surfaces: Fujii's form of the Oren-Nayar model with a lobe for multiple scattering.",
      .formula =
          "f = f_ss + f_ms\n"
          "f_ss = rho / pi A (1 + r s / t),  s = <o_t, i_t>,  t = max(cos_o, cos_i) if s > 0, else 1\n"
          "f_ms = rho_ms / pi (1 - E(o)) (1 - E(i)) / (1 - <E>)",
      .properties = "Reciprocal. Conserves energy; reflects all light for rho = 1.",
      .sampling = "A clipped linearly transformed cosine, mixed with uniform directions.",
      .limitations = "None known.",
      .source = "[Portsmouth et al. 2025]",
  };
  template <class Color>
  using Lobes = std::tuple<Eon<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 1, {0, 1}, "Diffuse reflectance, multiplies the base colour"};
  Number<float> roughness{"roughness", "Roughness", 0.5f, {0, 1}, "Higher is rougher; 0 is Lambert's model"};
  auto parameters() { return std::tie(diffuse, roughness); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    Eon<Rgb> lobe;
    lobe.albedo = base * diffuse;
    lobe.roughness = roughness;
    lobes.add(lobe);
  }
};

}  // namespace etendue
