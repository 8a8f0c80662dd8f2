// Measured materials of the RGL database.                                         Dupuy and Jakob 2018; thesis item 45
//
// The formulas are in material/rgl_brdf.h. As it was measured: neither exactly reciprocal nor held to conserve energy.
// Without a file it is Lambert's model.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/measured/measured_data.h"
#include "bsdf/measured/measured_lobe.h"

namespace etendue {

struct RglModel {
  static constexpr BsdfModelDescription kDescription{
      "rgl", "Measured (RGL database)", ModelClass::measured,
      "A measured isotropic material from a file whose name ends in _rgb.bsdf (Dupuy and Jakob 2018), times the base "
      "colour. About reciprocal, as measurements are.",
      "by luminance and visible normals, as the paper has it; what leaves below the surface is absorbed"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, MeasuredLobe<Color, RglBrdf>>;

  Text file{"file", "File", kNoFile, "Path of a .bsdf file in RGB", accepts_rgl_file, {{kNoFile, "No file"}}};
  auto parameters() { return std::tie(file); }

  const RglBrdf* data = nullptr;  // kept for good
  void prepare() { data = rgl_data(file); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    if (data)
      lobes.add(MeasuredLobe<Rgb, RglBrdf>::of(*data, base));
    else
      lobes.add(Lambert<Rgb>{base});
  }
};

}  // namespace etendue
