// Properties of every set of lobes, for tests of glTF surfaces and BSDF models.
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "support/chi_square.h"
#include "support/directions.h"

namespace etendue::test {

// Significance level of each of `count` independent tests with a family-wise false-alarm rate of 1 % (Sidak).
inline double family_significance(size_t count) { return 1 - std::pow(0.99, 1.0 / static_cast<double>(count)); }

// Chi-square test of the directions that `lobes` samples for wo against their density. Delta samples count as absorbed.
template <class Lobes>
ChiSquare chi_square_of_samples(const Lobes& lobes, const Vec3& wo, Random& random, int samples) {
  return chi_square_on_sphere(
      [&](Vec3& wi) {
        LobeSample<Rgb> s;
        const bool sampled = lobes.sample(wo, random.lobe(), TransportMode::radiance, s) && !s.delta;
        wi = s.wi;
        return sampled;
      },
      [&](const Vec3& wi) { return lobes.pdf(wo, wi, TransportMode::radiance); }, samples);
}

inline std::string text_of(const ChiSquare& result) {
  return "chi2 " + std::to_string(result.statistic) + ", " + std::to_string(result.degrees) + " degrees of freedom";
}

// Checks that the components of all scattering types are non-negative and sum to f, and that a component without
// `has_component` is black.
template <class Lobes>
void expect_components_sum_to_f(const Lobes& lobes, const Vec3& wo, const Vec3& wi, const std::string& name) {
  const Rgb f = lobes.eval(wo, wi, TransportMode::radiance);
  Rgb sum(0);
  for (const ScatterType type : {ScatterType::diffuse, ScatterType::glossy, ScatterType::specular}) {
    const Rgb component = lobes.eval_component(type, wo, wi, TransportMode::radiance);
    ASSERT_TRUE(lobes.has_component(type) || is_black(component)) << name;
    for (int k = 0; k < 3; ++k) ASSERT_GE(component[k], 0) << name;
    sum += component;
  }
  for (int k = 0; k < 3; ++k) ASSERT_NEAR(sum[k], f[k], 1e-5f * f[k]) << name;
}

// Directional albedo for radiant power from wo: its largest component and the standard error of the estimate.
struct AlbedoEstimate {
  double value = 0, error = 0;
};
template <class Lobes>
AlbedoEstimate sampled_albedo(const Lobes& lobes, const Vec3& wo) {
  constexpr int kSamples = 20'000;
  Random random(11);
  double sum = 0, squares = 0;
  for (int i = 0; i < kSamples; ++i) {
    LobeSample<Rgb> s;
    if (!lobes.sample(wo, random.lobe(), TransportMode::importance, s)) continue;
    const double weight = max_component(s.weight);
    sum += weight;
    squares += sqr(weight);
  }
  const double mean = sum / kSamples;
  return {mean, std::sqrt((squares / kSamples - sqr(mean)) / kSamples)};
}

}  // namespace etendue::test
