// Reflection models with an albedo above one, and the corrected models beside them.
//    [Phong 1975; Blinn 1977; Ward 1992; Cook and Torrance 1982; Lafortune and Willems 1994]
#pragma once
#include "bsdf_analysis/albedo.h"
#include "stress/case.h"

namespace etendue::stress {

inline void models_that_make_light(TestContext& test) {
  using Settings = std::vector<std::pair<const char*, Value>>;
  const auto white_lobe = [](std::initializer_list<std::pair<const char*, Value>> more) {
    Settings s{{"diffuse", 0.0}, {"specular.r", 1.0}, {"specular.g", 1.0}, {"specular.b", 1.0}};
    s.insert(s.end(), more.begin(), more.end());
    return s;
  };
  const Value one = std::string("one");
  // The albedos were computed by numerical quadrature of the formulas.
  const struct {
    const char* model;
    Settings settings;
    double degrees, albedo;
  } rows[] = {
      {"phong", white_lobe({{"exponent", 10.0}}), 85, 1.0290},
      {"phong", white_lobe({{"exponent", 10.0}}), 89, 3.959},
      {"reciprocal-phong", white_lobe({{"exponent", 1.0}}), 0, 2.0944},
      {"blinn-phong", white_lobe({{"exponent", 10.0}}), 0, 1.5007},
      {"blinn-phong", white_lobe({{"exponent", 10.0}}), 89, 9.135},
      {"modified-phong", white_lobe({{"exponent", 10.0}}), 89, 0.1320},
      {"cook-torrance", white_lobe({{"m", 0.5}, {"fresnel", one}, {"masking", false}}), 89, 8.587},
      {"cook-torrance", white_lobe({{"m", 0.5}, {"fresnel", one}}), 89, 0.9954},
      {"ward", white_lobe({{"alpha-x", 0.5}, {"alpha-y", 0.5}}), 60, 0.3507},
      {"ward", white_lobe({{"alpha-x", 0.5}, {"alpha-y", 0.5}}), 89.9, 1.484},
  };
  for (const auto& row : rows) {
    auto model = make_bsdf_model(row.model);
    for (const auto& [name, value] : row.settings) model = model->with(name, value);
    bsdf_analysis::Lobes lobes;
    model->add_lobes(Rgb(1), lobes);
    const bsdf_analysis::Albedo albedo = bsdf_analysis::albedo_at(lobes, row.degrees, {20, 1 << 16});
    test.expect_near(row.model, "albedo at " + number(row.degrees) + " degrees", static_cast<double>(albedo.value.g),
                     row.albedo, (4.5 * albedo.error + 5e-4 * row.albedo) / row.albedo);
  }
}

inline constexpr Case kModelsThatMakeLight{
    .name = "models-that-make-light",
    .kind = Kind::broken_physics,
    .theory =
        "Phong and Blinn-Phong divide by one cosine, Ward by the root of two, and Cook-Torrance without "
        "masking by both. Their albedo exceeds one at grazing angles. Modified Phong and masked "
        "microfacets stay below one",
    .run = models_that_make_light};

}  // namespace etendue::stress
