// Blue-noise ordering of pixels: nets over samples and pixels, the error of groups of pixels, and independence of tiles
#include "sampling/blue_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/hash.h"
#include "integrator/shared/pixel_seeds.h"
#include "patterns/net_quality.h"
#include "sampling/pmj02.h"
#include "unit/sampling/points.h"

namespace etendue {
namespace {

SampleBlock block_of(const Sampler& sampler, uint64_t seed, int x, int y, uint32_t sample, uint32_t block) {
  SampleBlock values;
  sampler.block(integrator::PixelSeeds(sampler, seed, 0)(x, y), sample, block, values);
  return values;
}

// The 2^m samples of each aligned square of 2^k x 2^k pixels have one value in each of 2^(m + 2k) intervals, in all
// dimensions.
TEST(BlueNoise, SamplesOfSquaresOfPixelsAreStratified) {
  const BlueNoiseSampler sampler;
  for (const uint32_t block : {0U, 2U, 100U})
    for (const int m : {0, 1, 2, 3, 5})
      for (const int side : {1, 2, 4, 8, 32})
        for (size_t d = 0; d < kBlockSize; ++d) {
          const int cells = side * side << m;
          std::set<int> filled;
          for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
              for (uint32_t s = 0; s < 1U << m; ++s) {
                const float u = block_of(sampler, 5, 64 - 2 * side + x, side + y, s, block)[d];
                filled.insert(static_cast<int>(u * static_cast<float>(cells)));
              }
          ASSERT_EQ(filled.size(), static_cast<size_t>(cells)) << "dimension " << d << " side " << side << " m " << m;
        }
}

// The first sample of each two-dimensional decision is a net over the pixels of a square, and all samples of a pixel are.
TEST(BlueNoise, DecisionsAreNetsOverPixelsAndOverSamples) {
  const BlueNoiseSampler sampler;
  for (uint64_t seed = 0; seed < 10; ++seed)
    for (const uint32_t block : {0U, 3U, 50U})
      for (const size_t d : {size_t{0}, size_t{2}}) {
        std::vector<patterns::PlanePoint> pixels, samples;
        for (int i = 0; i < 64; ++i) {
          const auto over_pixels = block_of(sampler, seed, 16 + i % 8, 8 + i / 8, 0, block);
          const auto over_samples = block_of(sampler, seed, 3, 17, static_cast<uint32_t>(i), block);
          pixels.push_back({over_pixels[d], over_pixels[d + 1]});
          samples.push_back({over_samples[d], over_samples[d + 1]});
        }
        EXPECT_EQ(patterns::net_quality(pixels, 2), 0);
        EXPECT_EQ(patterns::net_quality(samples, 2), 0);
      }
}

// The error of x is uniform in one of N intervals for N pixels with one sample each: its mean over a square has the
// variance 1 / (12 N^3), that of independent pixels 1 / (12 N). The bounds are 4.5 standard errors: the sum of squares of
// almost normal numbers has the relative standard deviation sqrt(2 / repeats).
TEST(BlueNoise, ErrorsOfNeighbouringPixelsCancel) {
  constexpr int kRepeats = 4000;
  const auto variance_of_mean = [](const Sampler& sampler, int side) {
    double squares = 0;
    for (int r = 0; r < kRepeats; ++r) {
      double sum = 0;
      for (int i = 0; i < side * side; ++i)
        sum += block_of(sampler, static_cast<uint64_t>(r), 8 + i % side, 24 + i / side, 0, 1)[2] - 0.5;
      squares += sqr(sum / (side * side)) / kRepeats;
    }
    return squares;
  };
  const double bound = 4.5 * std::sqrt(2.0 / kRepeats);
  for (const int side : {1, 2, 4}) {
    const double n = side * side;
    EXPECT_NEAR(variance_of_mean(BlueNoiseSampler(), side) * 12 * n * n * n, 1, bound) << side;
    EXPECT_NEAR(variance_of_mean(Pmj02Sampler(), side) * 12 * n, 1, bound) << side;
  }
}

// Each pixel has the error of `pmj02`: the variance of the mean of x y over 16 samples. The two estimates have a relative
// standard error of 2 % each.
TEST(BlueNoise, PixelsHaveTheVarianceOfMultiJitteredSequences) {
  const auto variance = [](const Sampler& sampler) {
    constexpr int kRepeats = 5000;
    double squares = 0;
    for (int r = 0; r < kRepeats; ++r) {
      double sum = 0;
      for (uint32_t s = 0; s < 16; ++s) {
        const auto u = block_of(sampler, static_cast<uint64_t>(r), r % 32, r / 7 % 32, s, 1);
        sum += u[2] * u[3] - 0.25;
      }
      squares += sqr(sum / 16) / kRepeats;
    }
    return squares;
  };
  EXPECT_NEAR(variance(BlueNoiseSampler()) / variance(Pmj02Sampler()), 1, 4.5 * 0.02 * std::sqrt(2.0));
}

// Pixels at the same place of neighbouring tiles, and the half-buffers of a pixel, are independent: 4.5 standard errors.
TEST(BlueNoise, TilesAndHalfBuffersAreIndependent) {
  const BlueNoiseSampler sampler;
  constexpr int kRepeats = 20'000;
  double tiles = 0, halves = 0;
  for (int r = 0; r < kRepeats; ++r) {
    const auto seed = static_cast<uint64_t>(r);
    SampleBlock first, other_half;
    sampler.block(integrator::PixelSeeds(sampler, seed, 0)(40, 9), 0, 1, first);
    sampler.block(integrator::PixelSeeds(sampler, seed, 1)(40, 9), 0, 1, other_half);
    tiles += 12 * (first[2] - 0.5) * (block_of(sampler, seed, 72, 9, 0, 1)[2] - 0.5);
    halves += 12 * (first[2] - 0.5) * (other_half[2] - 0.5);
  }
  EXPECT_LT(std::abs(tiles), 4.5 * std::sqrt(kRepeats));
  EXPECT_LT(std::abs(halves), 4.5 * std::sqrt(kRepeats));
}

}  // namespace
}  // namespace etendue
