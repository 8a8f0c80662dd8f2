// The table of the directional albedo of GGX microfacets against quadrature.
#include "bsdf/microfacet/ggx_albedo.h"

#include <gtest/gtest.h>

#include <random>

#include "support/ggx_albedo_quadrature.h"

namespace etendue {
namespace {

// The stored values are rounded up to 1e-4.
TEST(GgxAlbedo, TableIsTheComputedOne) {
  const test::GgxAlbedoTable computed = test::computed_ggx_albedo_table();
  for (size_t r = 0; r < kGgxAlbedoRoughnesses; ++r)
    for (size_t c = 0; c < kGgxAlbedoCosines; ++c) {
      EXPECT_NEAR(kGgxAlbedoValues[r][c][0] * 1e-4, static_cast<double>(computed[r][c].a), 1.5e-4) << r << ' ' << c;
      EXPECT_NEAR(kGgxAlbedoValues[r][c][1] * 1e-4, static_cast<double>(computed[r][c].b), 1.5e-4) << r << ' ' << c;
    }
}

TEST(GgxAlbedo, InterpolationIsACloseUpperBound) {
  struct Range {
    double from, to, bound;  // roughness; error
  };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Range& range : {Range{0, 0.07, 0.11}, Range{0.07, 0.25, 0.06}, Range{0.25, 1, 0.005}})
    for (int k = 0; k < 300; ++k) {
      const double alpha = std::max(1e-4, sqr(range.from + (range.to - range.from) * uniform(random)));
      const double cosine = std::max(1e-4, sqr(uniform(random)));
      const GgxAlbedo exact = test::ggx_albedo_by_quadrature(cosine, alpha);
      const GgxAlbedo found = GgxAlbedoRow(static_cast<float>(alpha)).at(static_cast<float>(cosine));
      EXPECT_GE(found.a, exact.a) << alpha << ' ' << cosine;
      EXPECT_GE(found.b, exact.b) << alpha << ' ' << cosine;
      EXPECT_LE(static_cast<double>(found.a - exact.a), range.bound) << alpha << ' ' << cosine;
      EXPECT_LE(static_cast<double>(found.b - exact.b), range.bound) << alpha << ' ' << cosine;
    }
}

TEST(GgxAlbedo, MeanIsTheCosineWeightedIntegral) {
  for (const float alpha : {1e-4f, 0.01f, 0.2f, 0.7f, 1.0f}) {
    const GgxAlbedoRow row(alpha);
    constexpr int kSteps = 4000;
    double a = 0, b = 0;
    for (int k = 0; k < kSteps; ++k) {
      const GgxAlbedo e = row.at(std::sqrt((static_cast<float>(k) + 0.5f) / kSteps));
      a += static_cast<double>(e.a) / kSteps;
      b += static_cast<double>(e.b) / kSteps;
    }
    EXPECT_NEAR(static_cast<double>(row.mean().a), a, 1e-5) << alpha;
    EXPECT_NEAR(static_cast<double>(row.mean().b), b, 1e-5) << alpha;
  }
}

// Schlick's weight at the mean cosine is the weight of f90.
TEST(GgxAlbedo, MeanCosineHasTheMeanWeight) {
  for (const float alpha : {0.01f, 0.3f, 1.0f})
    for (const float cosine : {0.02f, 0.3f, 0.9f}) {
      const GgxAlbedo e = GgxAlbedoRow(alpha).at(cosine);
      EXPECT_NEAR(std::pow(1 - e.mean_cosine(), 5.0f) * e.total(), e.b, 1e-5f);
    }
}

}  // namespace
}  // namespace etendue
