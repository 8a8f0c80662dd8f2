// Randomisations in base 2: what each keeps of the unscrambled points.
#include "sampling/scrambling.h"

#include <gtest/gtest.h>

#include "patterns/net_quality.h"
#include "sampling/point_sets/niederreiter.h"
#include "sampling/sobol.h"
#include "unit/sampling/points.h"

namespace etendue {
namespace {

constexpr uint32_t kPoints = 64;

std::unique_ptr<Sampler> sampler_with(const std::string& name, const char* scrambling) {
  return make_sampler(name, {{"scrambling", std::string(scrambling)}});
}

patterns::PointSet plane_of(const Sampler& sampler, uint32_t seed) {
  patterns::PointSet set;
  for (const auto& p : test::points(sampler, seed, kPoints, 1)) set.push_back({double{p[0]}, double{p[1]}});
  return set;
}

TEST(Scrambling, NestedAndDigitalKeepNets) {
  for (const std::string name : {"sobol", "niederreiter", "hammersley"})
    for (const char* scrambling : {"owen", "digital-shift", "none"})
      for (uint32_t seed = 0; seed < 10; ++seed)
        EXPECT_EQ(patterns::net_quality(plane_of(*sampler_with(name, scrambling), mix_bits(seed)), 2), 0)
            << name << ' ' << scrambling;
}

// Without scrambling, the points are those of the sequence for every pixel, to the 24 bits of a float.
TEST(Scrambling, NoneGivesTheSequence) {
  for (const uint32_t seed : {1U, 77U}) {
    const auto sobol = test::points(*sampler_with("sobol", "none"), seed, kPoints, 8);
    const auto niederreiter = test::points(*sampler_with("niederreiter", "none"), seed, kPoints, 8);
    for (uint32_t i = 0; i < kPoints; ++i)
      for (uint32_t d = 0; d < 64; ++d) {
        EXPECT_EQ(sobol[i][d], to_unit_float(SobolSampler::point(i, d))) << i << ' ' << d;
        EXPECT_EQ(niederreiter[i][d], to_unit_float(NiederreiterSampler::point(i, d))) << i << ' ' << d;
      }
  }
}

// The random digits or the offset are the same for all points of a pixel and dimension, and differ between pixels.
TEST(Scrambling, ShiftsAreTheSameForAllPoints) {
  const auto bits = [](float x) { return static_cast<uint32_t>(x * 0x1p24f); };
  const auto plain = test::points(*sampler_with("sobol", "none"), 0, kPoints, 2);
  std::array<float, 2> first_shifts{};
  for (const uint32_t seed : {5U, 6U}) {
    const auto digital = test::points(*sampler_with("sobol", "digital-shift"), seed, kPoints, 2);
    const auto rotated = test::points(*sampler_with("sobol", "rotation"), seed, kPoints, 2);
    for (uint32_t i = 1; i < kPoints; ++i)
      for (uint32_t d = 0; d < 16; ++d) {
        EXPECT_EQ(bits(digital[i][d]) ^ bits(plain[i][d]), bits(digital[0][d]) ^ bits(plain[0][d])) << i << ' ' << d;
        const float offset = rotated[i][d] - plain[i][d] - rotated[0][d] + plain[0][d];
        EXPECT_NEAR(offset - std::round(offset), 0, 1e-6) << i << ' ' << d;
      }
    first_shifts[seed - 5] = rotated[0][0];
  }
  EXPECT_NE(first_shifts[0], first_shifts[1]);
}

// The integral of exp(x + y) with 64 points of one pixel is unbiased for every randomisation: its mean over 4000 pixels lies
// within 4.5 standard errors. Nested scrambling has the smallest variance.
TEST(Scrambling, RandomisationsAreUnbiased) {
  constexpr int kPixels = 4000;
  const double exact = sqr(std::exp(1.0) - 1);
  std::map<std::string, double> variances;
  for (const char* scrambling : {"owen", "digital-shift", "rotation"}) {
    const auto sampler = sampler_with("sobol", scrambling);
    double sum = 0, squares = 0;
    for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
      double value = 0;
      for (const auto& p : plane_of(*sampler, mix_bits(pixel + 3))) value += std::exp(p[0] + p[1]) / kPoints;
      sum += value - exact;
      squares += sqr(value - exact);
    }
    const double variance = squares / kPixels - sqr(sum / kPixels);
    EXPECT_LE(std::abs(sum / kPixels), 4.5 * std::sqrt(variance / kPixels)) << scrambling;
    variances[scrambling] = variance;
  }
  EXPECT_LT(variances["owen"], 0.5 * variances["digital-shift"]);
  EXPECT_LT(variances["owen"], 0.5 * variances["rotation"]);
}

}  // namespace
}  // namespace etendue
