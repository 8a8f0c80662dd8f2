// A narrow lobe as a table and in spherical harmonics, coarse and fine.   [Lang, sec. 4.2.2.4]
#pragma once
#include "bsdf_analysis/checks.h"
#include "stress/case.h"

namespace etendue::stress {

inline bsdf_analysis::Lobes lobes_of_model(const BsdfModel& model) {
  bsdf_analysis::Lobes lobes;
  model.add_lobes(Rgb(1), lobes);
  return lobes;
}

inline void table_of_a_model(TestContext& test) {
  const Value source =
      std::string("modified-phong diffuse=0.2 specular.r=0.5 specular.g=0.5 specular.b=0.5 exponent=60");
  auto phong = make_bsdf_model("modified-phong");
  phong = phong->with("diffuse", 0.2)->with("exponent", 60.0);
  for (const char* band : {"specular.r", "specular.g", "specular.b"}) phong = phong->with(band, 0.5);
  const auto exact = static_cast<double>(bsdf_analysis::albedo_at(lobes_of_model(*phong), 30, {20, 1 << 15}).value.g);
  const auto expect = [&](const char* name, const std::string& point, const bsdf_analysis::Lobes& lobes,
                          double max_error) {
    const auto albedo = static_cast<double>(bsdf_analysis::albedo_at(lobes, 30, {20, 1 << 15}).value.g);
    const bsdf_analysis::Plausibility p = bsdf_analysis::plausibility(lobes, {});
    test.expect_between(name, point + ", error of the albedo at 30 degrees", std::abs(albedo - exact) / exact, 0,
                        max_error);
    test.expect_between(name, point + ", asymmetry", p.asymmetry, 0, bsdf_analysis::Plausibility::kAsymmetry);
    test.expect_zero(name, point + ", negative or not finite values",
                     static_cast<double>(p.not_finite + (p.minimum < 0)));
  };
  const auto table = make_bsdf_model("tabulated")->with("source", source);
  for (const auto& [steps, error] : {std::pair<int64_t, double>{8, 0.5}, {24, 0.06}, {60, 0.01}})
    expect("tabulated", std::to_string(steps) + " steps",
           lobes_of_model(*table->with("polar-steps", steps)->with("azimuth-steps", 4 * steps)), error);
  const auto harmonics = make_bsdf_model("spherical-harmonics")->with("source", source);
  for (const auto& [bands, error] : {std::pair<int64_t, double>{4, 0.5}, {12, 0.3}, {24, 0.1}})
    expect("spherical-harmonics", std::to_string(bands) + " bands", lobes_of_model(*harmonics->with("bands", bands)),
           error);
}

inline constexpr Case kTableOfAModel{
    .name = "table-of-a-model",
    .kind = Kind::broken_physics,
    .theory =
        "Interpolation of a coarse table blurs a narrow lobe, and truncated harmonics ring. The albedo is "
        "wrong by an amount that decreases with resolution; signs and reciprocity are exact",
    .run = table_of_a_model};

}  // namespace etendue::stress
