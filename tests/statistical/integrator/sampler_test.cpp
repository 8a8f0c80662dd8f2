// Samplers: every sampler drives every integrator to the same image, and low-discrepancy points converge faster.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "integrator/integrator.h"
#include "render/incompatibility.h"
#include "sampling/sampler.h"
#include "scene/compiled_scene.h"
#include "support/scenes.h"

namespace etendue::sampler_test {
namespace {

// Scrambled Sobol' points give the same pixels with less noise.
TEST(Samplers, SobolHasLessErrorThanRandomOnCornell) {
  auto d = test::cornell(32);
  d.seed = 99;
  const auto reference = test::rendered(d, 4096);
  d.seed = 1;
  const auto mse = [&](const char* sampler) {
    d.method.sampler = sampler;
    const auto film = test::rendered(d, 64);
    double sum = 0;
    for (int y = 0; y < d.height; ++y)
      for (int x = 0; x < d.width; ++x)
        for (int c = 0; c < 3; ++c) sum += sqr(double{film.mean(x, y)[c]} - reference.mean(x, y)[c]);
    return sum;
  };
  EXPECT_GT(mse("random"), 2 * mse("sobol"));
}

constexpr uint32_t kSamples = 64;

// The mean of an image over independent seeds.
struct SeedMean {
  double mean, variance_of_mean;
};

SeedMean mean_over_seeds(render::Document d, int seeds) {
  double sum = 0, squares = 0;
  for (int i = 0; i < seeds; ++i) {
    d.seed = 1000 + static_cast<uint64_t>(i);
    const double value = test::mean_of(test::rendered(d, kSamples)).value;
    sum += value;
    squares += value * value;
  }
  const double mean = sum / seeds;
  return {mean, std::max(squares / seeds - mean * mean, 0.0) / (seeds - 1)};
}

class EverySampler : public ::testing::TestWithParam<std::string> {};

// The means of all samplers are those of `random`. With 12 seeds for each mean, their difference over its standard error
// has about Student's distribution of 11 to 22 degrees of freedom: 252 comparisons with the bound of 8.5 have a false alarm
// with a probability below 1e-3.
TEST_P(EverySampler, HasTheMeanOfRandomNumbers) {
  constexpr int kSeeds = 12;
  constexpr double kBound = 8.5;
  auto d = test::cornell(12);
  d.method.integrator = GetParam();
  // Less work before the first sample.
  for (const auto& [parameter, value] : {std::pair("photonmap.photons", "5000"), std::pair("radiosity.patches", "60")})
    d = *render::with_text(d, parameter, value);
  if (!render::incompatibility(d, *scene::compile(d.scene, d.camera, nullptr)).empty()) GTEST_SKIP();
  d.method.sampler = "random";
  const SeedMean random = mean_over_seeds(d, kSeeds);
  ASSERT_GT(random.mean, 0);
  EXPECT_LT(std::sqrt(random.variance_of_mean), 0.05 * random.mean) << "too noisy for a comparison";
  for (const SamplerInfo& sampler : sampler_infos()) {
    if (sampler.name == "random") continue;
    d.method.sampler = sampler.name;
    const SeedMean other = mean_over_seeds(d, kSeeds);
    const double rounding = 1e-6 * random.mean;
    EXPECT_LE(std::abs(other.mean - random.mean),
              kBound * std::sqrt(random.variance_of_mean + other.variance_of_mean) + rounding)
        << sampler.name << ": " << other.mean << ", random: " << random.mean;
  }
}

std::vector<std::string> all_integrators() {
  std::vector<std::string> names;
  for (const auto& info : integrator::integrator_infos()) names.push_back(info.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Samplers, EverySampler, ::testing::ValuesIn(all_integrators()), [](const auto& name) {
  std::string text = name.param;
  std::ranges::replace(text, '-', '_');
  return text;
});

}  // namespace
}  // namespace etendue::sampler_test
