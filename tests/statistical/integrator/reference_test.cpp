// Scenes from files against reference images by other renderers (see the README of the test data).
#include <gtest/gtest.h>

#include <algorithm>

#include "image/image.h"
#include "support/scenes.h"

namespace etendue::reference_test {
namespace {

constexpr int kBlocks = 8;
using Blocks = std::array<double, kBlocks * kBlocks>;

template <class Pixel>
Blocks block_means(int width, int height, Pixel&& pixel) {
  Blocks sums{}, counts{};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto block = static_cast<size_t>(y * kBlocks / height * kBlocks + x * kBlocks / width);
      sums[block] += pixel(x, y);
      ++counts[block];
    }
  for (size_t i = 0; i < sums.size(); ++i) sums[i] /= counts[i];
  return sums;
}

double mean_of(const Blocks& blocks) {
  double sum = 0;
  for (const double b : blocks) sum += b;
  return sum / static_cast<double>(blocks.size());
}

// Relative differences of block means.
struct Comparison {
  double mean_ratio, median_block, worst_block;
};

Comparison compare_with_reference(const std::string& name, uint32_t samples) {
  const std::string folder = test::data_folder() + "/scenes/" + name + "/";
  auto d = *render::new_document(folder + name + ".glb");
  d.width = d.height = 256;
  d.filter = film::FilterKind::box;
  const auto film = test::rendered(d, samples);
  const Blocks ours = block_means(256, 256, [&](int x, int y) { return double{average(film.mean(x, y))}; });
  const auto reference = image::read_exr(folder + "reference.exr");
  const auto& layer = *reference->find("");
  const size_t stride = layer.channels.size();
  const Blocks theirs = block_means(reference->width, reference->height, [&](int x, int y) {
    const size_t at =
        (static_cast<size_t>(y) * static_cast<size_t>(reference->width) + static_cast<size_t>(x)) * stride;
    return (double{layer.pixels[at]} + layer.pixels[at + 1] + layer.pixels[at + 2]) / 3;
  });
  Blocks differences{};
  for (size_t i = 0; i < ours.size(); ++i) differences[i] = std::abs(ours[i] / theirs[i] - 1);
  std::ranges::sort(differences);
  return {mean_of(ours) / mean_of(theirs), differences[differences.size() / 2], differences.back()};
}

TEST(Reference, CornellBox) {
  if (test::data_folder().empty()) GTEST_SKIP() << "ETENDUE_TEST_DATA is not a folder";
  const auto c = compare_with_reference("cornell-box", 256);
  EXPECT_NEAR(c.mean_ratio, 1, 0.003);
  EXPECT_LT(c.worst_block, 0.03);
  RecordProperty("mean", std::to_string(c.mean_ratio));
  RecordProperty("worst", std::to_string(c.worst_block));
}

// The reference has layered plastic, which the glTF file approximates by a coat: single blocks of floor and steps differ
// by up to 30 %, walls by the noise of 64 samples.
TEST(Reference, Staircase2) {
  if (test::data_folder().empty()) GTEST_SKIP() << "ETENDUE_TEST_DATA is not a folder";
  const auto c = compare_with_reference("staircase2", 64);
  EXPECT_NEAR(c.mean_ratio, 1, 0.02);
  EXPECT_LT(c.median_block, 0.03);
  EXPECT_LT(c.worst_block, 0.3);
}

TEST(Reference, VeachBidir) {
  if (test::data_folder().empty()) GTEST_SKIP() << "ETENDUE_TEST_DATA is not a folder";
  const auto c = compare_with_reference("veach-bidir", 64);
  EXPECT_NEAR(c.mean_ratio, 1.02, 0.06);
}

}  // namespace
}  // namespace etendue::reference_test
