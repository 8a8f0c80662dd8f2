// Adaptive sampling: unbiased, independent of the number of threads, resumable, and more efficient than uniform
// sampling.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "render/adaptive_sampling.h"
#include "render/checkpoint.h"
#include "support/scenes.h"

namespace etendue {
namespace {

// Several tiles, so that there is an allocation to decide.
render::Document adaptive_cornell(const char* sampler) {
  auto d = test::cornell(96);
  d.method.sampler = sampler;
  d.method.adaptive = render::Adaptive::rmse;
  return d;
}

bool same_bits(const film::Film& a, const film::Film& b) {
  return a.pixels().size() == b.pixels().size() &&
         std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
}

double squared_error(const film::Film& film, const film::Film& reference) {
  double sum = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      for (int c = 0; c < 3; ++c) sum += sqr(double{film.mean(x, y)[c]} - reference.mean(x, y)[c]);
  return sum;
}

TEST(Adaptive, BeatsUniformSamplingAtEqualSampleCount) {
  for (const char* sampler : {"random", "sobol"}) {
    auto adaptive = adaptive_cornell(sampler), even = adaptive;
    even.method.adaptive = render::Adaptive::off;
    auto much = even;
    much.method.sampler = "sobol";
    much.seed = 99;
    const auto reference = test::rendered(much, 1024);
    const double gain =
        squared_error(test::rendered(even, 128), reference) / squared_error(test::rendered(adaptive, 128), reference);
    EXPECT_GT(gain, 1.25) << sampler;
  }
}

// The mean over images with few samples, where the allocation depends most on the samples, against uniform sampling:
// z-tests over blocks of the image with a false-alarm rate of 1 % for the family of 36. The noise comes from a small
// light that few paths hit.
TEST(Adaptive, IsUnbiased) {
  constexpr int kSize = 96, kCells = 6, kReplicates = 150;
  auto d = *render::with_text(adaptive_cornell("random"), "render.integrator", "path-pure");
  d = *render::with_text(d, "path-pure.max-depth", "3");
  const auto estimate = [&](render::Adaptive adaptive, uint64_t first_seed) {
    std::array<std::array<double, 2>, kCells * kCells> sums{};  // of the means and of their squares
    d.method.adaptive = adaptive;
    for (uint64_t r = 0; r < kReplicates; ++r) {
      d.seed = first_seed + r;
      const auto film = test::rendered(d, 16);
      std::array<double, kCells * kCells> cells{};
      for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x)
          cells[static_cast<size_t>(y * kCells / kSize * kCells + x * kCells / kSize)] += luminance(film.mean(x, y));
      for (size_t i = 0; i < cells.size(); ++i) {
        sums[i][0] += cells[i];
        sums[i][1] += sqr(cells[i]);
      }
    }
    return sums;
  };
  const auto adaptive = estimate(render::Adaptive::rmse, 1), even = estimate(render::Adaptive::off, 10'000);
  for (size_t i = 0; i < adaptive.size(); ++i) {
    const auto mean = [&](const auto& sum) { return sum[0] / kReplicates; };
    const auto variance = [&](const auto& sum) { return (sum[1] / kReplicates - sqr(mean(sum))) / (kReplicates - 1); };
    const double z = (mean(adaptive[i]) - mean(even[i])) / std::sqrt(variance(adaptive[i]) + variance(even[i]));
    EXPECT_LT(std::abs(z), 3.64) << "cell " << i;
  }
}

TEST(Adaptive, BitIdenticalWithOneTwoAndSevenThreads) {
  const auto d = adaptive_cornell("sobol");
  const auto one = test::rendered(d, 40, 1);
  EXPECT_TRUE(same_bits(one, test::rendered(d, 40, 2)));
  EXPECT_TRUE(same_bits(one, test::rendered(d, 40, 7)));
}

TEST(Adaptive, ResumesToTheSameBits) {
  const auto path = std::filesystem::temp_directory_path() / "etendue-test-adaptive.checkpoint";
  auto d = adaptive_cornell("sobol");
  const auto whole = test::rendered(d, 60);
  ASSERT_TRUE(render::write_checkpoint(path, {render::state_json(d, 20), test::rendered(d, 20), 1.5}));
  auto checkpoint = render::read_checkpoint(path);
  ASSERT_TRUE(checkpoint);
  auto again = render::document_from_state(checkpoint->state, path.string());
  ASSERT_TRUE(again);
  EXPECT_EQ(again->method.adaptive, render::Adaptive::rmse);
  d.limits = {60, 0, 0};
  render::Session second({.threads = 2, .interactive = false});
  second.submit(d, std::move(checkpoint->film));
  second.finish();
  EXPECT_TRUE(same_bits(whole, second.film_copy()));
  std::filesystem::remove(path);
}

// Two tiles of equal size: twice the deviation gives twice the samples, every tile has at least the uniform part, and
// the total does not exceed the budget.
TEST(SampleAllocation, SamplesAreProportionalToDeviations) {
  render::SampleAllocation allocation(render::Adaptive::rmse, {512, 512, 512});
  film::TileVariance spread(3);
  for (uint32_t half : {0U, 1U}) {
    spread.record(0, half, 2, {4, 1, true});
    spread.record(1, half, 2, {1, 1, true});
    spread.record(2, half, 2, {0, 1, true});
  }
  while (allocation.target(0, 0) == 4) allocation.advance(spread);
  for (uint32_t half : {0U, 1U}) {
    const uint32_t first = allocation.target(0, half), second = allocation.target(1, half);
    EXPECT_EQ(allocation.target(2, half), 4U);
    EXPECT_NEAR(first / static_cast<double>(second), 2, 0.3);
    EXPECT_LE(first + second + 4, 24U);
    EXPECT_GE(first + second + 4, 22U);
  }
}

// The allocation of one half-buffer is computed from the other half-buffer.
TEST(SampleAllocation, AHalfBufferDoesNotDetermineItsOwnAllocation) {
  const auto target = [](float own, float other) {
    render::SampleAllocation allocation(render::Adaptive::rmse, {512, 512});
    film::TileVariance spread(2);
    for (uint32_t half : {0U, 1U}) spread.record(1, half, 2, {1, 1, true});
    spread.record(0, 0, 2, {own, 1, true});
    spread.record(0, 1, 2, {other, 1, true});
    while (allocation.target(0, 0) == 4 && allocation.target(1, 0) == 4) allocation.advance(spread);
    return allocation.target(0, 0);
  };
  EXPECT_EQ(target(1, 9), target(100, 9));
  EXPECT_NE(target(1, 1), target(1, 9));
}

}  // namespace
}  // namespace etendue
