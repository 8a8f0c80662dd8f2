// Measured materials of the MERL database.                                                   [Matusik et al. 2003]
//
// measured/merl_brdf.h describes the file format.
//
//   Parameters   file: path of a .binary file. The values are multiplied by the base colour. Without a file the model
//                is Lambert's.
//   Properties   Reciprocal. Energy is that of the measurement.
//   Sampling     A table of f cos_i, 24 x 96 x 64 cells, mixed with 5 % cosine (measured/direction_table.h).
//   Limitations  Isotropic materials only.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/measured/measured_data.h"
#include "bsdf/measured/measured_lobe.h"

namespace etendue {

struct MerlModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "merl",
      .label = "Measured (MERL database)",
      .model_class = ModelClass::measured,
      .summary = "A measured isotropic material from a .binary file of the MERL database, times the base colour.",
      .formula = "f = table(theta_h, theta_d, phi_d), linearly interpolated",
      .properties = "Reciprocal. Energy is that of the measurement.",
      .sampling = "A table of f cos_i, 24 x 96 x 64 cells, mixed with 5 % cosine.",
      .limitations = "Isotropic materials only. Without a file it is Lambert's model.",
      .source = "[Matusik et al. 2003]",
  };
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, MeasuredLobe<Color, SampledBrdf<MerlBrdf>>>;

  Text file{"file", "File", kNoFile, "Path of a measurement, NAME.binary", accepts_merl_file, {{kNoFile, "No file"}}};
  auto parameters() { return std::tie(file); }

  const SampledBrdf<MerlBrdf>* data = nullptr;  // null without a file; valid until the program ends
  void prepare() { data = merl_data(file); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    if (data)
      lobes.add(MeasuredLobe<Rgb, SampledBrdf<MerlBrdf>>::of(*data, base));
    else
      lobes.add(Lambert<Rgb>{base});
  }
};

}  // namespace etendue
