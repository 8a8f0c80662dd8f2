// Every phase function of the registry: normalisation, mean cosine, sampling; published values and limits.
#include "medium/phase_function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "medium/medium_presets.h"
#include "support/chi_square.h"

namespace etendue {
namespace {

using Phase = std::shared_ptr<const PhaseFunction>;

Phase made(const char* name, const std::vector<Setting>& settings = {}) {
  const auto phase = make_phase_function(name, settings);
  EXPECT_TRUE(phase) << name << phase.error().message;
  return *phase;
}

struct Case {
  std::string name;
  Phase phase;
};

// The default of every phase function, and each numeric parameter at its limits and in between.
std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const PhaseFunctionInfo& info : phase_function_infos()) {
    const std::string name = info.description.name;
    cases.push_back({name, make_phase_function(name)});
    for (const ParameterInfo& p : info.parameters) {
      if (p.type != ParameterType::number) continue;
      for (const double t : {0.0, 0.02, 0.3, 0.5, 0.95, 1.0}) {
        const double value = p.min + t * (p.max - p.min);
        cases.push_back({name + " " + p.name + "=" + std::to_string(value), cases[0].phase});
        cases.back().phase = make_phase_function(name)->with(p.name, value);
      }
    }
  }
  return cases;
}

// Integrates f(x) p(x) over all directions; intervals shrink geometrically towards x = 1 and x = -1.
template <class F>
double integral(const PhaseFunction& phase, F&& f) {
  double sum = 0, from = 0;
  for (double to = 1e-11; from < 1; to *= 1.01) {
    const double end = std::min(to, 1.0), middle = 0.5 * (from + end), w = (end - from) / 6;
    for (const auto& [v, weight] : {std::pair(from, w), std::pair(middle, 4 * w), std::pair(end, w)})
      for (const double x : {1 - v, v - 1}) sum += weight * phase.eval(x) * f(x);
    from = end;
  }
  return 2 * std::numbers::pi * sum;
}

TEST(PhaseFunction, IsNormalisedAndNotNegative) {
  for (const Case& c : all_cases()) {
    EXPECT_NEAR(integral(*c.phase, [](double) { return 1; }), 1, 1e-5) << c.name;
    for (double x = -1; x <= 1; x += 1.0 / 64) {
      EXPECT_GE(c.phase->eval(x), 0) << c.name;
      EXPECT_TRUE(std::isfinite(c.phase->eval(x))) << c.name;
    }
  }
}

TEST(PhaseFunction, MeanCosineIsAsStated) {
  for (const Case& c : all_cases())
    EXPECT_NEAR(integral(*c.phase, [](double x) { return x; }), c.phase->mean_cosine(), 1e-5) << c.name;
}

// Inversion: the distribution function at a sampled cosine is the random number. Checked by the density alone.
TEST(PhaseFunction, SamplesAreTheInverseOfTheDistributionFunction) {
  for (const Case& c : all_cases()) {
    if (c.name.starts_with("m") || c.name.starts_with("d")) continue;  // mixtures select a lobe first
    double last = -1;
    for (int i = 0; i <= 40; ++i) {
      const double u = i / 40.0 * (1 - 1e-12), x = c.phase->sample_cosine(u);
      EXPECT_GE(x, -1) << c.name;
      EXPECT_LE(x, 1) << c.name;
      EXPECT_GE(x, last - 1e-12) << c.name;
      last = x;
      const double step = 1e-4, before = c.phase->sample_cosine(std::max(u - step, 0.0)),
                   after = c.phase->sample_cosine(std::min(u + step, 1 - 1e-12));
      if (i == 0 || i == 40 || after - before > 0.05) continue;
      // The share of probability between two sampled cosines, by Simpson's rule.
      const double share = 2 * std::numbers::pi * (after - before) / 6 *
                           (c.phase->eval(before) + 4 * c.phase->eval(0.5 * (before + after)) + c.phase->eval(after));
      EXPECT_NEAR(share, 2 * step, 2e-3 * step) << c.name << " u=" << u;
    }
  }
}

// Chi-square of sampled directions; 1 % false alarms over all cases.
TEST(PhaseFunction, SampledDirectionsFollowTheDensity) {
  const std::vector<Case> cases = all_cases();
  const double limit = 0.01 / static_cast<double>(cases.size());
  for (const Case& c : cases) {
    // Peaks that are narrower than a cell of the test are covered by the test of the inverse.
    if (c.phase->eval(1) > 50 || c.phase->eval(-1) > 50) continue;
    std::mt19937 generator(7);
    std::uniform_real_distribution<float> uniform(0, kOneMinusEpsilon);
    const Vec3 wo = glm::normalize(Vec3(0.3f, -0.5f, 0.8f));
    const auto result = test::chi_square_on_sphere(
        [&](Vec3& wi) {
          wi = c.phase->sample(wo, Vec2(uniform(generator), uniform(generator)));
          return true;
        },
        [&](const Vec3& wi) { return static_cast<double>(c.phase->eval(wo, wi)); }, 40000);
    EXPECT_GT(result.p_value, limit) << c.name << ": " << result.statistic << " of " << result.degrees;
  }
}

// The test above detects samples of another density.
TEST(PhaseFunction, ChiSquareDetectsAnotherAsymmetry) {
  const Phase sampled = made("henyey-greenstein", {{"g", 0.55}}), stated = made("henyey-greenstein", {{"g", 0.5}});
  std::mt19937 generator(7);
  std::uniform_real_distribution<float> uniform(0, kOneMinusEpsilon);
  const Vec3 wo(0, 0, 1);
  const auto result = test::chi_square_on_sphere(
      [&](Vec3& wi) {
        wi = sampled->sample(wo, Vec2(uniform(generator), uniform(generator)));
        return true;
      },
      [&](const Vec3& wi) { return static_cast<double>(stated->eval(wo, wi)); }, 40000);
  EXPECT_LT(result.p_value, 1e-4);
}

// Values in 1/sr at x = 1, 0 and -1, from the formulas of the sources.
TEST(PhaseFunction, PublishedValues) {
  const auto expect = [](const Phase& p, double forward, double side, double backward) {
    EXPECT_NEAR(p->eval(1), forward, 2e-5 * forward);
    EXPECT_NEAR(p->eval(0), side, 2e-5 * side);
    EXPECT_NEAR(p->eval(-1), backward, 2e-5 * backward);
  };
  expect(made("isotropic"), .0795775, .0795775, .0795775);
  expect(made("henyey-greenstein", {{"g", 0.6}}), .795775, .0321116, .012434);
  expect(made("henyey-greenstein", {{"g", -0.8}}), .00491219, .0136404, 3.58099);
  expect(made("modified-henyey-greenstein", {{"isotropic", 0.3}, {"g", 0.6}}), .580916, .0463514, .032577);
  expect(made("rayleigh"), .119366, .0596831, .119366);
  expect(made("mie-hazy"), .397887, .0411876, .0397887);
  expect(made("mie-murky"), 1.35282, .0397887, .0397887);
}

// Positive k scatters forward; the sign in the source would scatter backward with mean cosine -0.645.
TEST(PhaseFunction, SchlickScattersForward) {
  const Phase p = made("schlick", {{"k", 0.8112}});
  EXPECT_NEAR(p->eval(1), .763404, 2e-5);
  EXPECT_NEAR(p->eval(-1), .00829518, 2e-6);
  EXPECT_NEAR(p->mean_cosine(), .645260, 1e-5);
}

TEST(PhaseFunction, CornetteShanksIsRayleighWithoutAsymmetry) {
  const Phase a = made("cornette-shanks", {{"g", 0.0}}), b = made("rayleigh");
  for (double x = -1; x <= 1; x += 0.125) EXPECT_NEAR(a->eval(x), b->eval(x), 1e-15);
  for (double u = 0; u < 1; u += 0.0625) EXPECT_NEAR(a->sample_cosine(u), b->sample_cosine(u), 1e-9);
}

// At |g| = 1 the function is that of 0.999: finite, and almost all light continues ahead.
TEST(PhaseFunction, ExtremeAsymmetryIsFinite) {
  for (const double g : {-1.0, 1.0}) {
    for (const char* name : {"henyey-greenstein", "cornette-shanks"}) {
      const Phase p = made(name, {{"g", g}});
      EXPECT_NEAR(p->mean_cosine(), g, 2e-3) << name;
      EXPECT_TRUE(std::isfinite(p->eval(g))) << name;
      const Vec3 wo = glm::normalize(Vec3(1, 2, 3)), wi = p->sample(wo, {0.5f, 0.2f});
      EXPECT_GT(static_cast<float>(-g) * glm::dot(wo, wi), 0.999f) << name;
      EXPECT_TRUE(std::isfinite(p->eval(wo, wi))) << name;
    }
  }
}

// Directions are evaluated with the accuracy of the angle, not of its cosine.
TEST(PhaseFunction, NarrowPeaksAreResolved) {
  const Phase p = made("henyey-greenstein", {{"g", 0.999}});
  const Vec3 wo(0, 0, -1);
  for (const double angle : {1e-4, 3e-4, 1e-3, 3e-3}) {
    const Vec3 wi(static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle)));
    EXPECT_NEAR(p->eval(wo, wi) / p->eval(std::cos(angle)), 1, 2e-3) << angle;
  }
}

TEST(PhaseFunction, TablesAreChecked) {
  for (const char* values : {"", "1", "0 0 0", "1 -1", "1 x 2", "1 nan", "1 inf"})
    EXPECT_FALSE(make_phase_function("tabulated", {{"values", std::string(values)}})) << values;
  const auto wrong = make_phase_function("tabulated", {{"values", std::string("1 2 oops 3")}});
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message.find("value 3"), std::string::npos) << wrong.error().message;
  EXPECT_NEAR(made("tabulated", {{"values", std::string("1 1 1")}})->eval(0.3), 0.25 * std::numbers::inv_pi, 1e-12);
  EXPECT_NEAR(made("tabulated", {{"values", std::string("0 1")}})->mean_cosine(), 1.0 / 3, 1e-12);
}

TEST(PhaseFunction, InvalidParametersAreErrors) {
  for (const double g : {-1.5, 1.01, std::nan("")})
    EXPECT_FALSE(make_phase_function("henyey-greenstein", {{"g", g}})) << g;
  EXPECT_FALSE(make_phase_function("henyey-greenstein", {{"k", 0.5}}));
  const auto unknown = make_phase_function("mie", {});
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("mie-hazy"), std::string::npos);
}

TEST(MediumPreset, AreValidAndFound) {
  for (const MediumPreset& preset : medium_presets()) {
    EXPECT_EQ(find_medium_preset(preset.name), &preset);
    EXPECT_EQ(preset_of(preset.medium), preset.name);
    EXPECT_FALSE(preset.source.empty()) << preset.name;
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(preset.medium.scattering[c], 0) << preset.name;
      EXPECT_GE(preset.medium.absorption[c], 0) << preset.name;
    }
  }
  EXPECT_EQ(preset_of({Rgb(0.1f), Rgb(0), {}}), kNoMediumPreset);
}

}  // namespace
}  // namespace etendue
