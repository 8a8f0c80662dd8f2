// A polished surface: an ideal mirror with a Fresnel term.                    [Lang, eq. 4.102-4.104, corrected]
//
//   f = rho F(cos_i) delta(wi - r) / cos_i,       r the mirror direction of wo about the shading normal
//
//   Parameters   fresnel, eta, kappa: the Fresnel term and the index of refraction (fresnel_term.h); rho is the base
//                colour
//   Properties   Reciprocal. Conserves energy; the albedo is rho F.
//   Sampling     The mirror direction; the weight is rho F.
//   Limitations  A dielectric absorbs the refracted light; dielectric_model.h transmits it.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/fresnel/optical_constants.h"
#include "bsdf/lobes/mirror.h"

namespace etendue {

struct FresnelMirrorModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "fresnel-mirror",
      .label = "Mirror, Fresnel",
      .model_class = ModelClass::idealised,
      .summary = "Polished metal, or the specular reflection of a polished dielectric with a black interior.",
      .formula = "f = rho F(cos_i) delta(wi - r) / cos_i",
      .properties = "Reciprocal. Conserves energy; the albedo is rho F.",
      .sampling = "The mirror direction.",
      .limitations = "Light that a dielectric refracts is absorbed.",
      .source = "[Lang, eq. 4.102-4.104, corrected]",
  };
  template <class Color>
  using Lobes = std::tuple<Mirror<Color>>;

  FresnelParameters fresnel;
  auto parameters() { return fresnel.parameters(); }
  static std::vector<ModelPreset> presets() { return fresnel_presets(); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    lobes.add(Mirror<Rgb>{{}, base, fresnel.term()});
  }
};

}  // namespace etendue
