// An isotropic model or table in spherical harmonics.                                  [Lang, eq. 4.202-4.205]
//
// measured/harmonic_brdf.h has the formulas.
//
//   Parameters   source: an isotropic model with parameters, "ward alpha-x=0.2 alpha-y=0.2", or the path of a table;
//                bands: the number of bands. The values are multiplied by the base colour.
//   Properties   Reciprocal, also if the source is not: both orders of the directions are averaged. Clamping negative
//                values adds energy.
//   Sampling     A table of f cos_i, 24 x 48 x 32 cells, mixed with 5 % cosine (measured/direction_table.h).
//   Limitations  One band represents Lambert's model exactly; narrow lobes need many bands and ring with few.
//                Clamping adds 35 %, 39 % and 8 % of energy with 6, 12 and 24 bands for a modified Phong lobe of n =
//                100 without a diffuse term, and nothing for that model's default diffuse term.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/measured/measured_data.h"
#include "bsdf/measured/measured_lobe.h"

namespace etendue {

struct SphericalHarmonicsModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "spherical-harmonics",
      .label = "Spherical harmonics",
      .model_class = ModelClass::measured,
      .summary =
          "An isotropic model or table projected on spherical harmonics in both directions, times the base colour.",
      .formula = "f(o, i) = max(0, sum over m, l, l' of c(m, l, l') p(l, m, cos_o) p(l', m, cos_i) cos(m dphi))",
      .properties = "Reciprocal. Clamping negative values adds energy.",
      .sampling = "A table of f cos_i, 24 x 48 x 32 cells, mixed with 5 % cosine.",
      .limitations = "Narrow lobes need many bands and ring with few.",
      .source = "[Lang, eq. 4.202-4.205]",
  };
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, MeasuredLobe<Color, SampledBrdf<HarmonicBrdf>>>;

  Text source{"source",
              "Source",
              "modified-phong",
              "Isotropic model with parameters as NAME=VALUE, or the path of a table",
              accepts_harmonic_source,
              {{"modified-phong", "Modified Phong"},
               {"lambert", "Lambert"},
               {"ward", "Ward"},
               {"tabulated", "Tabulated (default table)"},
               {"oren-nayar", "Oren-Nayar"}}};
  Number<int> bands{"bands", "Bands", 8, {1, 24}, "Number of bands; more resolve narrower lobes"};
  auto parameters() { return std::tie(source, bands); }

  const SampledBrdf<HarmonicBrdf>* data = nullptr;  // valid until the program ends
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
