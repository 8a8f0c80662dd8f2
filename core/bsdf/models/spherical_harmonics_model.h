// Any other isotropic model in spherical harmonics.                                             thesis (4.150), item 46
//
// The formulas are in material/harmonic_brdf.h. Reciprocal, also where its source is not: both orders are averaged. One
// band holds Lambert's model exactly; narrow lobes need many bands, and ring with few. What is negative is cut off and
// adds as much energy: of the modified Phong lobe of n = 100 alone 35 %, 39 % and 8 % with 6, 12 and 24 bands; nothing
// with the diffuse part of the model's default under it.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/measured/measured_data.h"
#include "bsdf/measured/measured_lobe.h"

namespace etendue {

struct SphericalHarmonicsModel {
  static constexpr BsdfModelDescription kDescription{
      "spherical-harmonics", "Spherical harmonics", ModelClass::measured,
      "An isotropic model or table projected on so many bands of spherical harmonics in both directions, times the "
      "base "
      "colour. Reciprocal; what rings below zero is cut off.",
      "by a table of its own values, 24 x 48 x 32 cells, with a twentieth by the cosine"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, MeasuredLobe<Color, SampledBrdf<HarmonicBrdf>>>;

  Text source{"source",
              "Source",
              "modified-phong",
              "An isotropic model, with settings after it as KNOB=VALUE, or the path of a table",
              accepts_harmonic_source,
              {{"modified-phong", "Modified Phong"},
               {"lambert", "Lambert"},
               {"ward", "Ward"},
               {"tabulated", "The table that Tabulated makes at first"},
               {"oren-nayar", "Oren-Nayar"}}};
  Number<int> bands{"bands", "Bands", 8, {1, 24}, "Bands of the harmonics: l below this number"};
  auto parameters() { return std::tie(source, bands); }

  const SampledBrdf<HarmonicBrdf>* data = nullptr;  // kept for good
  void prepare() { data = harmonic_data(source, bands); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    if (data)
      lobes.add(MeasuredLobe<Rgb, SampledBrdf<HarmonicBrdf>>::of(*data, base));
    else
      lobes.add(Lambert<Rgb>{Rgb(0)});
  }
};

}  // namespace etendue
