// Measured materials of the MERL database.                                    Matusik et al. 2003; thesis item 45
//
// The format is described in material/merl_brdf.h. Reciprocal; energy is as it was measured. Without a file it is
// Lambert's model.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/measured/measured_data.h"
#include "bsdf/measured/measured_lobe.h"

namespace etendue {

struct MerlModel {
  static constexpr BsdfModelDescription kDescription{
      "merl", "Measured (MERL database)", ModelClass::measured,
      "A measured isotropic material from a .binary file (Matusik et al. 2003), times the base colour. Reciprocal.",
      "by a table of its own values, 24 x 96 x 64 cells, with a twentieth by the cosine"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, MeasuredLobe<Color, SampledBrdf<MerlBrdf>>>;

  Text file{"file", "File", kNoFile, "Path of a .binary file", accepts_merl_file, {{kNoFile, "No file"}}};
  auto parameters() { return std::tie(file); }

  const SampledBrdf<MerlBrdf>* data = nullptr;  // kept for good
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
