// Firefly reweighting [Zirr et al. 2018]: frequent values are kept, single bright samples are suppressed, and the
// result converges to the mean.
#include "film/firefly_reweighting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace etendue::film {
namespace {

TEST(FireflyReweighting, UniformImagesAreUnchanged) {
  for (const float value : {0.0f, 1e-6f, 0.01f, 0.7f, 8.0f, 5e4f, 1e9f}) {
    FireflyReweighting reweighting(3, 3);
    for (uint32_t s = 1; s <= 16; ++s) {
      for (int i = 0; i < 9; ++i) reweighting.add(i % 3, i / 3, Rgb(value, 0.5f * value, 0));
      for (int i = 0; i < 9; ++i) EXPECT_NEAR(reweighting.displayed(i % 3, i / 3, s).r, value, 1e-5f * value) << s;
    }
  }
}

TEST(FireflyReweighting, BatchesEqualSingleSamples) {
  FireflyReweighting alone(1, 1), together(1, 1);
  for (int i = 0; i < 20; ++i) alone.add(0, 0, Rgb(2));
  together.add(0, 0, Rgb(2), 20);
  EXPECT_NEAR(alone.displayed(0, 0, 20).r, together.displayed(0, 0, 20).r, 1e-5f);
}

TEST(FireflyReweighting, RemovesAFireflyAndKeepsItsNeighbours) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  FireflyReweighting reweighting(9, 9);
  constexpr uint32_t kSamples = 32;
  for (uint32_t s = 0; s < kSamples; ++s)
    for (int i = 0; i < 81; ++i) reweighting.add(i % 9, i / 9, Rgb(uniform(engine)));
  const Rgb before = reweighting.displayed(4, 4, kSamples);
  reweighting.add(4, 4, Rgb(3000));
  const Rgb after = reweighting.displayed(4, 4, kSamples + 1);
  EXPECT_NEAR(after.r, before.r, 0.1f);  // 91 with the firefly
  reweighting.add(3, 4, Rgb(uniform(engine)));
  EXPECT_NEAR(reweighting.displayed(3, 4, kSamples + 1).r, 0.5f, 0.2f);
}

// One sample in fifty is a thousand times brighter than the others. The suppressed part decreases with the sample
// count.
TEST(FireflyReweighting, ConvergesToTheMean) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> uniform(0, 1);
  FireflyReweighting reweighting(8, 8);
  double sum = 0, last = 1;
  uint32_t samples = 0;
  for (const uint32_t target : {16U, 128U, 1024U, 8192U}) {
    for (; samples < target; ++samples)
      for (int i = 0; i < 64; ++i) {
        const float value = uniform(engine) < 0.02f ? 100 : 0.1f;
        sum += static_cast<double>(value);
        reweighting.add(i % 8, i / 8, Rgb(value));
      }
    double shown = 0;
    for (int i = 0; i < 64; ++i) shown += static_cast<double>(reweighting.displayed(i % 8, i / 8, samples).r) * samples;
    const double missing = 1 - shown / sum;
    EXPECT_GT(missing, -1e-4);
    EXPECT_LT(missing, last) << target;
    last = missing + 1e-4;
  }
  EXPECT_LT(last, 1e-3);
}

TEST(FireflyReweighting, BordersAndClearedRows) {
  FireflyReweighting reweighting(2, 2);
  reweighting.add(0, 0, Rgb(500));
  reweighting.add(1, 1, Rgb(1), 8);
  EXPECT_LT(reweighting.displayed(0, 0, 8).r, 1.0f);
  EXPECT_NEAR(reweighting.displayed(1, 1, 8).r, 1, 1e-5f);
  reweighting.clear_rows(0, 1);
  EXPECT_EQ(reweighting.displayed(0, 0, 8), Rgb(0));
  EXPECT_NEAR(reweighting.displayed(1, 1, 8).r, 1, 1e-5f);
}

}  // namespace
}  // namespace etendue::film
