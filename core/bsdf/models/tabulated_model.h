// The virtual gonioreflectometer: any other model as a table.                                   thesis 4.2.2.4, item 45
//
// The table is described in material/brdf_table.h. Reciprocal where its source is. Lambert's model is exact at any
// size; a lobe that is narrower than the steps is washed out, and its energy may be more or less than that of the
// source.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/measured/measured_data.h"
#include "bsdf/measured/measured_lobe.h"

namespace etendue {

struct TabulatedModel {
  static constexpr BsdfModelDescription kDescription{
      "tabulated", "Tabulated (virtual gonioreflectometer)", ModelClass::measured,
      "A model measured at equal steps of its angles and read back by interpolation, or a table from a file, times the "
      "base colour. Reciprocal where its source is.",
      "by a table of its own values, 24 x 96 x 64 cells, with a twentieth by the cosine"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, MeasuredLobe<Color, SampledBrdf<BrdfTable>>>;

  Text source{"source",
              "Source",
              "modified-phong",
              "A model, with settings after it as KNOB=VALUE, or the path of a table",
              accepts_table_source,
              {{"modified-phong", "Modified Phong"},
               {"lambert", "Lambert"},
               {"ward", "Ward"},
               {"cook-torrance", "Cook-Torrance"},
               {"torrance-sparrow", "Torrance-Sparrow"},
               {"oren-nayar", "Oren-Nayar"}}};
  Number<int> polar{"polar-steps", "Polar steps", 24, {2, 90}, "Steps of both polar angles over 90 degrees"};
  Number<int> azimuths{"azimuth-steps", "Azimuth steps", 72, {8, 360}, "Steps of the azimuth over the circle"};
  auto parameters() { return std::tie(source, polar, azimuths); }

  const SampledBrdf<BrdfTable>* data = nullptr;  // kept for good
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
