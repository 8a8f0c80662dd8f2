// Every reflection model, with each of its parameters at either end of its range.
#pragma once
#include "bsdf_analysis/plausibility.h"
#include "stress/case.h"

namespace etendue::stress {

// Pairs of directions that formulas with half vectors, cosines below them and powers of cosines stumble over: straight
// through, straight back, mirrored, along the surface.
inline size_t failures_at_odd_pairs(const bsdf_analysis::Lobes& lobes) {
  size_t failures = 0;
  for (const double degrees : {0.0, 1e-4, 30.0, 45.0, 89.99, 90.0, 150.0}) {
    const Vec3 wo = bsdf_analysis::direction(degrees, 20);
    const Vec3 flat(0, 1, 0), barely = glm::normalize(Vec3(0, 1, 1e-7f));
    for (const Vec3& wi : {-wo, wo, Vec3(-wo.x, -wo.y, wo.z), Vec3(wo.x, wo.y, -wo.z), flat, barely})
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
  return failures_at_odd_pairs(lobes) + p.not_finite + (p.least < 0);
}

inline void models_at_their_ends(Lab& lab) {
  for (const BsdfModelInfo& info : bsdf_model_infos()) {
    const auto usual = make_bsdf_model(info.description.name);
    size_t failures = failures_of(*usual);
    for (const ParameterInfo& p : info.parameters) {
      if (p.type != ParameterType::number && p.type != ParameterType::integer) continue;
      for (const double end : {p.min, p.max}) failures += failures_of(*usual->with(p.name, end));
    }
    for (const ModelPreset& preset : info.presets) failures += failures_of(*with_preset(usual, preset.name));
    lab.expect_zero(info.description.name, "values below zero or no numbers", static_cast<double>(failures));
  }
}

inline constexpr Case kModelsAtTheirEnds{
    "models-at-their-ends", Kind::parameters,
    "Exponents of 0 and 100000, facets without any slope and of the steepest, indices of one: whatever a model's "
    "parameters, and for light straight back, straight through or along the surface, f is a number and not negative",
    models_at_their_ends};

}  // namespace etendue::stress
