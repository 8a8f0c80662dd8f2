// Reflection models whose albedo exceeds one, and those beside them that mend it.
#pragma once
#include "bsdf_analysis/albedo.h"
#include "stress/case.h"

namespace etendue::stress {

inline void models_that_make_light(Lab& lab) {
  using Settings = std::vector<std::pair<const char*, Value>>;
  const auto lobe_of_one = [](std::initializer_list<std::pair<const char*, Value>> more) {
    Settings s{{"diffuse", 0.0}, {"specular.r", 1.0}, {"specular.g", 1.0}, {"specular.b", 1.0}};
    s.insert(s.end(), more.begin(), more.end());
    return s;
  };
  const Value one = std::string("one");
  // Angle and albedo by quadrature of the formulas.
  const struct {
    const char* model;
    Settings settings;
    double degrees, albedo;
  } rows[] = {
      {"phong", lobe_of_one({{"exponent", 10.0}}), 85, 1.0290},
      {"phong", lobe_of_one({{"exponent", 10.0}}), 89, 3.959},
      {"reciprocal-phong", lobe_of_one({{"exponent", 1.0}}), 0, 2.0944},
      {"blinn-phong", lobe_of_one({{"exponent", 10.0}}), 0, 1.5007},
      {"blinn-phong", lobe_of_one({{"exponent", 10.0}}), 89, 9.135},
      {"modified-phong", lobe_of_one({{"exponent", 10.0}}), 89, 0.1320},
      {"cook-torrance", lobe_of_one({{"m", 0.5}, {"fresnel", one}, {"masking", false}}), 89, 8.587},
      {"cook-torrance", lobe_of_one({{"m", 0.5}, {"fresnel", one}}), 89, 0.9954},
      {"ward", lobe_of_one({{"alpha-x", 0.5}, {"alpha-y", 0.5}}), 60, 0.3507},
      {"ward", lobe_of_one({{"alpha-x", 0.5}, {"alpha-y", 0.5}}), 89.9, 1.484},
  };
  for (const auto& row : rows) {
    auto model = make_bsdf_model(row.model);
    for (const auto& [name, value] : row.settings) model = model->with(name, value);
    bsdf_analysis::Lobes lobes;
    model->add_lobes(Rgb(1), lobes);
    const bsdf_analysis::Albedo found = bsdf_analysis::albedo_at(lobes, row.degrees, {20, 1 << 16});
    lab.expect_near(row.model, "albedo at " + number(row.degrees) + " degrees", static_cast<double>(found.value.g),
                    row.albedo, (4.5 * found.error + 5e-4 * row.albedo) / row.albedo);
  }
}

inline constexpr Case kModelsThatMakeLight{
    "models-that-make-light", Kind::broken_physics,
    "Phong and Blinn divide by one cosine, Ward by the root of two, facets without masking by both: their albedo grows "
    "beyond one towards grazing light; Lafortune's form of Phong, and facets that mask each other, stay below",
    models_that_make_light};

}  // namespace etendue::stress
