// A thin pane of glass: two interfaces and all reflections between them in one surface.
//
//   T = (1 - F) / (1 + F),   R = 2 F / (1 + F)         for clear glass, averaged over both polarisations
//
// lobes/thin_dielectric.h has the formulas for tinted glass. Light is transmitted without a change of direction.
//
//   Parameters   eta: index of refraction of the glass. The base colour is the transmittance of one crossing at
//                normal incidence.
//   Properties   Reciprocal. R + T = 1 for a white base colour.
//   Sampling     Reflection or transmission in proportion to R and T.
//   Limitations  No displacement of the ray, no interference. Differs from the thin transmission of glTF
//                (lobes/thin_transmission.h), which has one interface.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/fresnel/optical_constants.h"
#include "bsdf/lobes/thin_dielectric.h"

namespace etendue {

struct ThinDielectricModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "thin-sheet",
      .label = "Thin sheet of glass",
      .model_class = ModelClass::idealised,
      .summary =
          "A thin pane with all reflections between its two interfaces. The base colour is the transmittance of one "
          "crossing at normal incidence.",
      .formula = "T = (1 - F) / (1 + F),  R = 2 F / (1 + F)  for clear glass, averaged over both polarisations",
      .properties = "Reciprocal. R + T = 1 for a white base colour.",
      .sampling = "Reflection or transmission in proportion to R and T.",
      .limitations = "Does not displace the ray; no interference.",
      .source = "[Lang, eq. 4.67, 4.68, 4.72]",
  };
  template <class Color>
  using Lobes = std::tuple<ThinDielectric<Color>>;

  Number<float> eta{
      "eta", "IOR \u03b7", 1.5f, {1, 4}, "Index of refraction of the glass over that of its surroundings"};
  auto parameters() { return std::tie(eta); }
  static std::vector<ModelPreset> presets() { return dielectric_presets(); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    lobes.add(ThinDielectric<Rgb>{{}, base, eta});
  }
};

}  // namespace etendue
