// Every reflection model, with each of its parameters at both ends of its range.   [Lang, sec. 4.2.2.3]
#pragma once
#include "bsdf_analysis/plausibility.h"
#include "stress/case.h"

namespace etendue::stress {

// Counts invalid values for pairs of directions at which half vectors, divisions by cosines and powers of cosines are
// singular: straight through, straight back, mirrored, along the surface.
inline size_t failures_at_singular_pairs(const bsdf_analysis::Lobes& lobes) {
  size_t failures = 0;
  for (const double degrees : {0.0, 1e-4, 30.0, 45.0, 89.99, 90.0, 150.0}) {
    const Vec3 wo = bsdf_analysis::direction(degrees, 20);
    const Vec3 tangent(0, 1, 0), nearly_tangent = glm::normalize(Vec3(0, 1, 1e-7f));
    for (const Vec3& wi : {-wo, wo, Vec3(-wo.x, -wo.y, wo.z), Vec3(wo.x, wo.y, -wo.z), tangent, nearly_tangent})
      for (const auto mode : {TransportMode::radiance, TransportMode::importance}) {
        const Rgb f = lobes.eval(wo, wi, mode);
        const float pdf = lobes.pdf(wo, wi, mode);
        failures += !is_finite(f) || f.r < 0 || f.g < 0 || f.b < 0 || !std::isfinite(pdf) || pdf < 0;
      }
  }
  return failures;
}

inline size_t failures_of(const BsdfModel& model) {
  bsdf_analysis::Lobes lobes;
  model.add_lobes(Rgb(0.8f, 0.6f, 0.4f), lobes);
  const bsdf_analysis::Plausibility p = bsdf_analysis::plausibility(lobes, {});
  return failures_at_singular_pairs(lobes) + p.not_finite + (p.minimum < 0);
}

inline void models_at_their_ends(TestContext& test) {
  for (const BsdfModelInfo& info : bsdf_model_infos()) {
    const auto model = make_bsdf_model(info.description.name);
    size_t failures = failures_of(*model);
    for (const ParameterInfo& p : info.parameters) {
      if (p.type != ParameterType::number && p.type != ParameterType::integer) continue;
      for (const double end : {p.min, p.max}) failures += failures_of(*model->with(p.name, end));
    }
    for (const ModelPreset& preset : info.presets) failures += failures_of(*with_preset(model, preset.name));
    test.expect_zero(info.description.name, "negative or not finite values", static_cast<double>(failures));
  }
}

inline constexpr Case kModelsAtTheirEnds{
    .name = "models-at-their-ends",
    .kind = Kind::parameters,
    .theory =
        "f is finite and not negative for exponents of 0 and 100000, facets without slope and with the "
        "largest, and indices of one. This includes light straight back, straight through and along the "
        "surface",
    .run = models_at_their_ends};

}  // namespace etendue::stress
