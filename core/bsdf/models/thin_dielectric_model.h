// A thin sheet of glass: both of its interfaces in one surface.                              thesis item 39, E8, E10
//
// The formulas are in material/pane.h. Not glTF's thin transmission (material/thin_sheet.h), which has one interface.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/fresnel/optical_constants.h"
#include "bsdf/lobes/thin_dielectric.h"

namespace etendue {

struct ThinDielectricModel {
  static constexpr BsdfModelDescription kDescription{
      "thin-sheet", "Thin sheet of glass", ModelClass::idealised,
      "Two interfaces and all reflections between them: T = (1 - F)/(1 + F), R = 2F/(1 + F) for clear glass, by "
      "polarisation. The base colour is what one crossing at a right angle leaves. Reciprocal, R + T = 1 if white.",
      "reflection or transmission by their shares"};
  template <class Color>
  using Lobes = std::tuple<ThinDielectric<Color>>;

  Number<float> eta{"eta", "Index", 1.5f, {1, 4}, "Index of refraction of the sheet over that around it"};
  auto parameters() { return std::tie(eta); }
  static std::vector<ModelPreset> presets() { return dielectric_presets(); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    lobes.add(ThinDielectric<Rgb>{{}, base, eta});
  }
};

}  // namespace etendue
