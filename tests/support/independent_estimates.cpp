#include "support/independent_estimates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "support/sanitizer.h"

namespace etendue::test {
namespace {

constexpr int kBlock = 4, kBlocks = kSize / kBlock;
constexpr int kReplicates = kHasSanitizer ? 2 : 12;

// Two-sided quantile of Student's t distribution: |t| exceeds it with probability `alarms` (Cornish-Fisher expansion).
double quantile_of_t(double alarms, double degrees) {
  double low = 0, high = 10;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (std::erfc(middle / std::sqrt(2.0)) > alarms ? low : high) = middle;
  }
  const double z = low, z2 = z * z;
  return z + z * (z2 + 1) / (4 * degrees) + z * ((5 * z2 + 16) * z2 + 3) / (96 * degrees * degrees);
}

// Threshold for a family-wise false-alarm rate of 1 %: Sidak correction over the blocks and the mean of each
// comparison.
double threshold(int comparisons) {
  return quantile_of_t(1 - std::pow(0.99, 1.0 / (comparisons * (kBlocks * kBlocks + 1))), 2 * (kReplicates - 1));
}

double block_mean(const film::Film& film, size_t block) {
  const int x0 = static_cast<int>(block) % kBlocks * kBlock, y0 = static_cast<int>(block) / kBlocks * kBlock;
  double sum = 0;
  for (int y = y0; y < y0 + kBlock; ++y)
    for (int x = x0; x < x0 + kBlock; ++x) sum += average(film.mean(x, y));
  return sum / (kBlock * kBlock);
}

double total(const std::vector<double>& values) { return std::reduce(values.begin(), values.end(), 0.0); }

// Whether the images see a block often enough for a t-test: its standard error is below a third of its mean.
bool is_resolved(const Estimate& e, size_t block) { return std::sqrt(e.variance[block]) < e.mean[block] / 3; }

// Whether a block has less than a twentieth of the mean radiance in both estimates.
bool is_dark(const Estimate& x, const Estimate& y, size_t block) {
  const auto dark = [&](const Estimate& e) {
    return e.mean[block] < 0.05 * total(e.mean) / static_cast<double>(e.mean.size());
  };
  return dark(x) && dark(y);
}

}  // namespace

Estimate Estimate::operator+(const Estimate& other) const {
  Estimate sum = *this;
  for (size_t i = 0; i < mean.size(); ++i) {
    sum.mean[i] += other.mean[i];
    sum.variance[i] += other.variance[i];
  }
  return sum;
}

Blocks block_means(const film::Film& film) {
  Blocks means;
  for (size_t i = 0; i < kBlocks * kBlocks; ++i) means.push_back(block_mean(film, i));
  return means;
}

Estimate replicated(render::Document d, uint32_t samples, uint64_t first_seed) {
  const auto image = [&](uint64_t seed) {
    d.seed = seed;
    return block_means(rendered(d, samples));
  };
  return replicated(image, first_seed);
}

Estimate replicated(const std::function<Blocks(uint64_t seed)>& image, uint64_t first_seed) {
  std::vector<double> sum, squares;
  for (int r = 0; r < kReplicates; ++r) {
    const Blocks means = image(first_seed + static_cast<uint64_t>(r));
    sum.resize(means.size());
    squares.resize(means.size());
    for (size_t i = 0; i < means.size(); ++i) {
      sum[i] += means[i];
      squares[i] += means[i] * means[i];
    }
  }
  Estimate e;
  for (size_t i = 0; i < sum.size(); ++i) {
    const double mean = sum[i] / kReplicates;
    e.mean.push_back(mean);
    const double variance = std::max(0.0, squares[i] / kReplicates - mean * mean) / (kReplicates - 1);
    e.variance.push_back(variance);
  }
  return e;
}

void expect_agreement(const Estimate& x, const Estimate& y, const std::string& what, int comparisons) {
  const double t = threshold(comparisons);
  double difference = 0, variance = 0;
  for (size_t i = 0; i < x.mean.size(); ++i) {
    difference += x.mean[i] - y.mean[i];
    variance += x.variance[i] + y.variance[i];
    if (is_dark(x, y, i) && !(is_resolved(x, i) && is_resolved(y, i))) continue;
    const double error = std::sqrt(x.variance[i] + y.variance[i]);
    EXPECT_LE(std::abs(x.mean[i] - y.mean[i]), t * error + 1e-6) << what << " block " << i;
  }
  EXPECT_LE(std::abs(difference), t * std::sqrt(variance) + 1e-6) << what << " mean";
}

render::Document glossy_scene() {
  scene::Scene scene;
  add(scene, quad(4), diffuse(Rgb(0.6f)));
  Material metal, glass, clear, sheet, clay;
  metal.base_color = {0.9f, 0.7f, 0.4f};
  metal.roughness = 0.4f;
  glass.metallic = 0;
  glass.transmission = 1;
  glass.thickness = 1;
  glass.roughness = 0.3f;
  glass.attenuation_color = {0.4f, 0.8f, 0.9f};
  glass.attenuation_distance = 0.7f;
  clear = glass;
  clear.roughness = 0;
  sheet = glass;
  sheet.thickness = 0;
  sheet.transmission = 0.7f;
  clay.base_color = {0.7f, 0.3f, 0.2f};
  clay.metallic = 0;
  clay.roughness = 0.3f;
  const Material* materials[] = {&metal, &glass, &clear, &sheet, &clay};
  for (int i = 0; i < 5; ++i) {
    Mat4 place(1);
    place[3] = Vec4(-2.2f + 1.1f * static_cast<float>(i), 0.55f, 0, 1);
    add(scene, sphere(0.5f, 16, false), *materials[i], place);
  }
  Material light = diffuse(Rgb(0), Rgb(6));
  Mat4 above(1);
  above[1][1] = -1;
  above[2][2] = -1;
  above[3] = Vec4(0, 3, 1, 1);
  add(scene, quad(1), light, above);
  scene.environment.tint = {0.2f, 0.25f, 0.3f};
  return document(scene, look_at({0, 2, 5}, {0, 0.4f, 0}, {0, 1, 0}, 0.8f), kSize, kSize);
}

}  // namespace etendue::test
