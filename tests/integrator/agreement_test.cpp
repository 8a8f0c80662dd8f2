// Every unbiased method gives the same image: z-tests over independent renderings, 1 % false alarms for the family.
#include <gtest/gtest.h>

#include "integrator/integrator.h"
#include "support/scenes.h"

namespace etendue {
namespace {

// Blocks of pixels, so that rare bright paths have become a normal distribution.
constexpr int kSize = 16, kBlock = 4, kBlocks = kSize / kBlock;
constexpr int kReplicates = 12;

struct Estimate {
  std::vector<double> mean, variance;  // per block, of the mean over replicates
};

double block_mean(const film::Film& film, size_t block) {
  const int x0 = static_cast<int>(block) % kBlocks * kBlock, y0 = static_cast<int>(block) / kBlocks * kBlock;
  double sum = 0;
  for (int y = y0; y < y0 + kBlock; ++y)
    for (int x = x0; x < x0 + kBlock; ++x) sum += average(film.mean(x, y));
  return sum / (kBlock * kBlock);
}

Estimate replicated(render::Document d, uint32_t samples) {
  constexpr size_t n = kBlocks * kBlocks;
  std::vector<double> sum(n, 0), squares(n, 0);
  for (int r = 0; r < kReplicates; ++r) {
    d.seed = static_cast<uint64_t>(1000 + r);
    const auto film = test::rendered(d, samples);
    for (size_t i = 0; i < n; ++i) {
      const double v = block_mean(film, i);
      sum[i] += v, squares[i] += v * v;
    }
  }
  Estimate e;
  for (size_t i = 0; i < n; ++i) {
    const double mean = sum[i] / kReplicates;
    e.mean.push_back(mean);
    e.variance.push_back((squares[i] / kReplicates - mean * mean) / (kReplicates - 1));
  }
  return e;
}

// Two-sided quantile of Student's t for the family: 22 degrees, Sidak over 16 blocks and the mean, p = 1 - 0.99^(1/17).
constexpr double kBlockT = 4.0;

void expect_agreement(const render::Document& d, uint32_t samples_of_first, const std::string& first,
                      uint32_t samples_of_second, const std::string& second) {
  auto a = d, b = d;
  a.method.integrator = first, b.method.integrator = second;
  const Estimate x = replicated(a, samples_of_first), y = replicated(b, samples_of_second);
  double difference = 0, variance = 0;
  for (size_t i = 0; i < x.mean.size(); ++i) {
    const double error = std::sqrt(x.variance[i] + y.variance[i]);
    EXPECT_LE(std::abs(x.mean[i] - y.mean[i]), kBlockT * error + 1e-6) << first << ' ' << second << " block " << i;
    difference += x.mean[i] - y.mean[i], variance += x.variance[i] + y.variance[i];
  }
  EXPECT_LE(std::abs(difference), kBlockT * std::sqrt(variance)) << first << ' ' << second << " mean";
}

TEST(Agreement, CornellBox) {
  auto d = *render::new_document("cornell");
  d.width = d.height = kSize;
  expect_agreement(d, 256, "path", 2048, "path-pure");
}

// Rough metal, rough and smooth glass under an area light and an environment: every lobe and every weight takes part.
TEST(Agreement, GlossyThings) {
  scene::Scene scene;
  test::add(scene, test::quad(4), test::diffuse(Rgb(0.6f)));
  Material metal, glass, clear, sheet;
  metal.base_color = {0.9f, 0.7f, 0.4f}, metal.roughness = 0.4f;
  glass.metallic = 0, glass.transmission = 1, glass.thickness = 1, glass.roughness = 0.3f;
  glass.attenuation_color = {0.4f, 0.8f, 0.9f}, glass.attenuation_distance = 0.7f;
  clear = glass, clear.roughness = 0;
  sheet = glass, sheet.thickness = 0, sheet.transmission = 0.7f;
  const Material* materials[] = {&metal, &glass, &clear, &sheet};
  for (int i = 0; i < 4; ++i) {
    Mat4 place(1);
    place[3] = Vec4(-1.8f + 1.2f * static_cast<float>(i), 0.55f, 0, 1);
    test::add(scene, test::sphere(0.5f, 16, false), *materials[i], place);
  }
  Material light = test::diffuse(Rgb(0), Rgb(6));
  Mat4 above(1);
  above[1][1] = -1, above[2][2] = -1;
  above[3] = Vec4(0, 3, 1, 1);
  test::add(scene, test::quad(1), light, above);
  scene.environment.tint = {0.2f, 0.25f, 0.3f};
  auto d = test::document(scene, look_at({0, 2, 5}, {0, 0.4f, 0}, {0, 1, 0}, 0.8f), kSize, kSize);
  expect_agreement(d, 512, "path", 1024, "path-pure");
}

// The depth limit cuts both at the same path length.
TEST(Agreement, DirectLightOnly) {
  auto d = *render::new_document("cornell");
  d.width = d.height = kSize;
  d = *render::with_text(d, "path.max-depth", "2");
  d = *render::with_text(d, "path-pure.max-depth", "2");
  expect_agreement(d, 128, "path", 2048, "path-pure");
}

// Scrambled points find the same pixels with less noise.
TEST(Samplers, SobolBeatsRandomOnCornell) {
  auto d = *render::new_document("cornell");
  d.width = d.height = 64;
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

}  // namespace
}  // namespace etendue
