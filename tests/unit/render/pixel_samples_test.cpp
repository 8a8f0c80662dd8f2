// Samples of a single pixel equal those of the rendering, and sample points equal those of the sampler.
#include "render/pixel_samples.h"

#include <gtest/gtest.h>

#include <set>

#include "support/scenes.h"

namespace etendue {
namespace {

constexpr Vec2i kPixel(12, 8);

std::shared_ptr<const scene::CompiledScene> compiled(const render::Document& d) {
  render::Session session({.threads = 1, .interactive = false});
  auto limited = d;
  limited.limits = {1, 0, 0};
  session.submit(limited);
  session.finish();
  return session.scene();
}

TEST(PixelSamples, MeanEqualsThePixelOfTheFilm) {
  constexpr uint32_t kSamples = 300;  // more than one table window in both half-buffers
  for (const char* sampler : {"sobol", "halton", "stratified", "random"})
    for (const char* integrator : {"path", "path-pure"}) {
      auto d = test::cornell(24);
      d.method.sampler = sampler;
      d.method.integrator = integrator;
      const auto film = test::rendered(d, kSamples);
      std::vector<Rgb> samples(kSamples);
      ASSERT_TRUE(render::PixelSamples(d, compiled(d), kPixel).draw(0, 0, samples));
      const Rgb expected = film.mean(kPixel.x, kPixel.y);
      ASSERT_GT(expected.g, 0) << sampler << " " << integrator;
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (const Rgb& s : samples) sum += double{s[c]};
        EXPECT_NEAR(sum / kSamples, expected[c], 1e-5 * expected[c]) << sampler << " " << integrator << " " << c;
      }
    }
}

TEST(PixelSamples, BatchesGiveTheSameSamples) {
  const auto d = test::cornell(40);
  const auto scene = compiled(d);
  std::vector<Rgb> whole(200), piece(70);
  ASSERT_TRUE(render::PixelSamples(d, scene, kPixel).draw(0, 0, whole));
  render::PixelSamples pieces(d, scene, kPixel);
  ASSERT_TRUE(pieces.draw(130, 0, piece));
  EXPECT_TRUE(std::equal(piece.begin(), piece.end(), whole.begin() + 130));
  ASSERT_TRUE(pieces.draw(0, 0, piece));
  EXPECT_TRUE(std::equal(piece.begin(), piece.end(), whole.begin()));
}

// Eight means of 64 samples against eight others. The difference of their averages in units of its standard error is
// Student's t with 14 degrees of freedom, which exceeds 4.1 once in a thousand runs. Seeds are fixed.
TEST(PixelSamples, ReplicatesAreIndependentSamplesWithTheSameMean) {
  const auto d = test::cornell(40);
  const auto scene = compiled(d);
  const auto moments = [&](uint32_t first_replicate) {
    double sum = 0, squares = 0;
    for (uint32_t r = first_replicate; r < first_replicate + 8; ++r) {
      std::vector<Rgb> samples(64);
      EXPECT_TRUE(render::PixelSamples(d, scene, kPixel).draw(0, r, samples));
      double mean = 0;
      for (const Rgb& s : samples) mean += double{luminance(s)} / 64;
      sum += mean / 8;
      squares += mean * mean / 8;
    }
    return std::pair(sum, (squares - sum * sum) / 7);
  };
  const auto [mean_a, variance_a] = moments(0);
  const auto [mean_b, variance_b] = moments(8);
  EXPECT_NE(mean_a, mean_b);
  EXPECT_LT(std::abs(mean_a - mean_b), 4.1 * std::sqrt(variance_a + variance_b));
}

TEST(PixelSamples, AreCancelledOnRequest) {
  const auto d = test::cornell(40);
  std::vector<Rgb> samples(64);
  EXPECT_FALSE(render::PixelSamples(d, compiled(d), kPixel).draw(0, 0, samples, [] { return false; }));
}

TEST(PathDimensions, HaveUniqueNamesAndPositions) {
  const auto list = render::path_dimensions(3);
  std::set<std::string> names;
  std::set<std::pair<uint32_t, int>> places;
  for (const auto& d : list) {
    names.insert(d.name);
    places.insert({d.block, d.index});
  }
  EXPECT_EQ(names.size(), list.size());
  EXPECT_EQ(places.size(), list.size());
  EXPECT_EQ(list.size(), 5U + 3 * 7);
}

// The first two dimensions of each half-buffer form a (0, m, 2)-net: 64 points, one in each cell of 8 x 8.
TEST(SamplePoints, EachHalfBufferOfSobolIsANet) {
  const auto d = test::cornell(40);
  const auto list = render::path_dimensions(1);
  const auto points = render::sample_points(d, kPixel, list[0], list[1], 128);
  std::array<std::set<int>, 2> cells;
  for (size_t i = 0; i < points.size(); ++i)
    cells[i % 2].insert(static_cast<int>(points[i].y * 8) * 8 + static_cast<int>(points[i].x * 8));
  EXPECT_EQ(cells[0].size(), 64U);
  EXPECT_EQ(cells[1].size(), 64U);
}

}  // namespace
}  // namespace etendue
