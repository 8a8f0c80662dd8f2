// Measured materials of the RGL database.                                                  [Dupuy and Jakob 2018]
//
// measured/rgl_brdf.h has the formulas.
//
//   Parameters   file: path of an isotropic RGB measurement, NAME_rgb.bsdf. The values are multiplied by the base
//                colour. Without a file the model is Lambert's.
//   Properties   Reciprocity and energy are those of the measurement, neither exact.
//   Sampling     Luminance and visible normals, as in the paper; samples below the surface are absorbed.
//   Limitations  Spectral and anisotropic measurements are not read.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/measured/measured_data.h"
#include "bsdf/measured/measured_lobe.h"

namespace etendue {

struct RglModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "rgl",
      .label = "Measured (RGL database)",
      .model_class = ModelClass::measured,
      .summary = "A measured isotropic material from an RGB file of the RGL database, times the base colour.",
      .formula = "f cos_i = spectrum(s) D(h) / (4 sigma(o))",
      .properties = "Reciprocity and energy are those of the measurement.",
      .sampling = "Luminance and visible normals, as in the paper; samples below the surface are absorbed.",
      .limitations = "Spectral and anisotropic measurements are not read. Without a file it is Lambert's model.",
      .source = "[Dupuy and Jakob 2018]",
  };
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, MeasuredLobe<Color, RglBrdf>>;

  Text file{
      "file", "File", kNoFile, "Path of an RGB measurement, NAME_rgb.bsdf", accepts_rgl_file, {{kNoFile, "No file"}}};
  auto parameters() { return std::tie(file); }

  const RglBrdf* data = nullptr;  // null without a file; valid until the program ends
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
