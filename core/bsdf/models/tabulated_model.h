// The virtual gonioreflectometer: a table of another model or of a file.                    [Lang, sec. 4.2.2.4]
//
// measured/brdf_table.h describes the table and its file format.
//
//   Parameters   source: a model with parameters, "ward alpha-x=0.1", or the path of a table; polar-steps,
//                azimuth-steps: the size of a table that is made from a model. The values are multiplied by the base
//                colour.
//   Properties   Reciprocal if the source is. Energy is about that of the source.
//   Sampling     A table of f cos_i, 24 x 96 x 64 cells, mixed with 5 % cosine (measured/direction_table.h).
//   Limitations  A lobe narrower than the steps is blurred and its energy changed. Lambert's model is exact at every
//                size. Deltas of the source are left out.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/measured/measured_data.h"
#include "bsdf/measured/measured_lobe.h"

namespace etendue {

struct TabulatedModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "tabulated",
      .label = "Tabulated (virtual gonioreflectometer)",
      .model_class = ModelClass::measured,
      .summary =
          "A table of another model, measured at equal steps of its angles and interpolated, or of a file, times the "
          "base colour.",
      .formula = "f = table(theta_o, theta_i, phi_i - phi_o), or table(theta_o, phi_o, theta_i, phi_i) if anisotropic",
      .properties = "Reciprocal if the source is. Energy is about that of the source.",
      .sampling = "A table of f cos_i, 24 x 96 x 64 cells, mixed with 5 % cosine.",
      .limitations = "A lobe narrower than the steps is blurred and its energy changed.",
      .source = "[Lang, sec. 4.2.2.4]",
  };
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, MeasuredLobe<Color, SampledBrdf<BrdfTable>>>;

  Text source{"source",
              "Source",
              "modified-phong",
              "Model to measure, with parameters as NAME=VALUE, or the path of a table",
              accepts_table_source,
              {{"modified-phong", "Modified Phong"},
               {"lambert", "Lambert"},
               {"ward", "Ward"},
               {"cook-torrance", "Cook-Torrance"},
               {"torrance-sparrow", "Torrance-Sparrow"},
               {"oren-nayar", "Oren-Nayar"}}};
  Number<int> polar{"polar-steps",
                    "Polar steps",
                    24,
                    {2, 90},
                    "Steps of each polar angle over 90 degrees; more resolve narrower lobes"};
  Number<int> azimuths{"azimuth-steps",
                       "Azimuth steps",
                       72,
                       {8, 360},
                       "Steps of the azimuth over 360 degrees; more resolve narrower lobes"};
  auto parameters() { return std::tie(source, polar, azimuths); }

  const SampledBrdf<BrdfTable>* data = nullptr;  // valid until the program ends
  void prepare() { data = table_data(source, polar, azimuths); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    if (data)
      lobes.add(MeasuredLobe<Rgb, SampledBrdf<BrdfTable>>::of(*data, base));
    else
      lobes.add(Lambert<Rgb>{Rgb(0)});
  }
};

}  // namespace etendue
