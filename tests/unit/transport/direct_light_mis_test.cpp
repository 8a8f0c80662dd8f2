// Weights of light sampling and BSDF sampling: their sum, their limits, and the identities between heuristics.
#include "transport/mis/direct_light_mis.h"

#include <gtest/gtest.h>

#include <limits>

namespace etendue::transport {
namespace {

using enum DirectLightHeuristic;
constexpr DirectLightHeuristic kAll[] = {constant, balance, cutoff, power, maximum, partition};
constexpr float kInfinity = std::numeric_limits<float>::infinity();

DirectLightMis mis_of(DirectLightHeuristic heuristic, float cutoff = 0.5f, float power = 2, int light_samples = 1) {
  DirectLightMis mis(heuristic);
  mis.cutoff = cutoff;
  mis.power = power;
  mis.light_samples = light_samples;
  return mis;
}

// The weight of all light samples of a vertex.
float light_weight(const DirectLightMis& mis, float light_pdf, float bsdf_pdf) {
  const float pdf = static_cast<float>(mis.light_samples) * light_pdf;
  return mis.light_weight_over_pdf(light_pdf, bsdf_pdf) * pdf;
}

TEST(DirectLightMis, WeightsSumToOne) {
  for (const auto heuristic : kAll)
    for (const float parameter : {0.25f, 0.5f, 1.0f})
      for (const int samples : {1, 3, 64})
        for (float light = 1e-12f; light < 1e15f; light *= 7)
          for (float bsdf = 1e-12f; bsdf < 1e15f; bsdf *= 11) {
            const DirectLightMis mis = mis_of(heuristic, parameter, 4 * parameter, samples);
            const float a = light_weight(mis, light, bsdf), b = mis.bsdf_weight(bsdf, light);
            EXPECT_NEAR(a + b, 1, 1e-5) << static_cast<int>(heuristic) << ' ' << light << ' ' << bsdf;
            EXPECT_GE(a, 0);
            EXPECT_GE(b, 0);
          }
}

// Without a density of BSDF sampling, light samples have the weight one, also infinitely dense ones.
TEST(DirectLightMis, LimitsOfDensities) {
  for (const auto heuristic : kAll) {
    const DirectLightMis mis = mis_of(heuristic);
    EXPECT_FLOAT_EQ(light_weight(mis, 2.5f, 0), 1) << static_cast<int>(heuristic);
    EXPECT_FLOAT_EQ(mis.bsdf_weight(2.5f, 0), 1) << static_cast<int>(heuristic);
    EXPECT_EQ(mis.bsdf_weight(0, 2.5f), 0) << static_cast<int>(heuristic);
    EXPECT_TRUE(std::isfinite(mis.bsdf_weight(kInfinity, kInfinity)));
    EXPECT_TRUE(std::isfinite(mis.light_weight_over_pdf(kInfinity, 1)));
  }
  for (const auto heuristic : {balance, cutoff, power, maximum}) {
    EXPECT_NEAR(mis_of(heuristic).bsdf_weight(kInfinity, 1), 1, 1e-6);
    EXPECT_NEAR(mis_of(heuristic).bsdf_weight(1, kInfinity), 0, 1e-6);
  }
}

// [Lang, Remark 6.31]
TEST(DirectLightMis, IdentitiesOfHeuristics) {
  for (float light = 0.01f; light < 100; light *= 1.7f)
    for (float bsdf = 0.01f; bsdf < 100; bsdf *= 1.9f) {
      const float expected = bsdf / (bsdf + light);
      EXPECT_FLOAT_EQ(mis_of(balance).bsdf_weight(bsdf, light), expected);
      EXPECT_FLOAT_EQ(mis_of(cutoff, 0).bsdf_weight(bsdf, light), expected);
      EXPECT_FLOAT_EQ(mis_of(power, 0.5f, 1).bsdf_weight(bsdf, light), expected);
      EXPECT_EQ(mis_of(cutoff, 1).bsdf_weight(bsdf, light), mis_of(maximum).bsdf_weight(bsdf, light));
      EXPECT_EQ(mis_of(maximum).bsdf_weight(bsdf, light), bsdf == light ? 0.5f : bsdf > light ? 1.0f : 0.0f);
    }
  EXPECT_FLOAT_EQ(mis_of(maximum).bsdf_weight(3, 3), 0.5f);
}

TEST(DirectLightMis, Values) {
  EXPECT_FLOAT_EQ(mis_of(constant).bsdf_weight(1, 100), 0.5f);
  EXPECT_FLOAT_EQ(mis_of(cutoff).bsdf_weight(1, 2.1f), 0);
  EXPECT_FLOAT_EQ(mis_of(cutoff).bsdf_weight(1, 1.9f), 1 / 2.9f);
  EXPECT_FLOAT_EQ(mis_of(power, 0.5f, 3).bsdf_weight(2, 1), 8.0f / 9);
  EXPECT_FLOAT_EQ(mis_of(partition).bsdf_weight(100, 1e-3f), 0);
  EXPECT_FLOAT_EQ(light_weight(mis_of(partition), 1e-3f, 100), 1);
}

// n light samples of density p count as one of density n p.
TEST(DirectLightMis, LightSamplesMultiplyTheDensity) {
  for (const auto heuristic : kAll) {
    const auto one = mis_of(heuristic), four = mis_of(heuristic, 0.5f, 2, 4);
    EXPECT_FLOAT_EQ(four.bsdf_weight(0.7f, 0.3f), one.bsdf_weight(0.7f, 1.2f));
    EXPECT_FLOAT_EQ(four.light_weight_over_pdf(0.3f, 0.7f), one.light_weight_over_pdf(1.2f, 0.7f));
  }
}

}  // namespace
}  // namespace etendue::transport
