// The guide of path tracing: its densities, what it learns, and its stored state.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/hash.h"
#include "equations/pearson_test.h"
#include "integrator/guiding/block_records.h"
#include "integrator/guiding/cosine_product.h"
#include "integrator/guiding/radiance_guide.h"
#include "support/chi_square.h"

namespace etendue {
namespace {

using guiding::DirectionalDistribution;
using guiding::DirectionalSums;
using guiding::RadianceGuide;
using guiding::Record;

Vec2 random_point(uint32_t k) {
  const uint64_t bits = mix_bits(uint64_t{k} * 0x9e3779b97f4a7c15ULL + 1);
  return {to_unit_float(static_cast<uint32_t>(bits)), to_unit_float(static_cast<uint32_t>(bits >> 32))};
}

// Distributions with cells of many sizes, of a narrow peak, a wide one and a constant.
std::vector<DirectionalDistribution> distributions_with_peaks() {
  const auto value = [](Vec2 p) {
    const auto peak = [&](Vec2 at, float width) { return std::exp(-glm::dot(p - at, p - at) / (width * width)); };
    return 200 * peak({0.3f, 0.7f}, 0.02f) + 5 * peak({0.8f, 0.2f}, 0.2f) + 0.1f;
  };
  DirectionalDistribution learned;
  DirectionalSums sums;
  for (int round = 0; round < 4; ++round) {
    sums = learned.cells(0.01f);
    for (uint32_t k = 0; k < 200'000; ++k) sums.add(random_point(k), value(random_point(k)));
    learned = sums.distribution(1e6f);
  }
  return {learned, sums.distribution(500), sums.distribution(3), {}};
}

TEST(DirectionalTree, MapOfTheSphereIsInverted) {
  for (uint32_t k = 0; k < 1000; ++k) {
    const Vec2 p = random_point(k), q = guiding::sphere_to_square(square_to_sphere(p));
    EXPECT_NEAR(p.x, q.x, 1e-6f);
    EXPECT_NEAR(p.y, q.y, 2e-5f);  // directions close to a pole are rounded
  }
  for (const Vec3& pole : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(-1, -0.0f, 0)}) {
    const Vec2 p = guiding::sphere_to_square(pole);
    EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
  }
}

// Cell corners are multiples of 2^-12, so the midpoint rule on this grid is exact up to rounding.
TEST(DirectionalTree, DensityIntegratesToOne) {
  const auto distributions = distributions_with_peaks();
  ASSERT_GT(distributions[0].nodes().size(), 30u);
  for (const DirectionalDistribution& d : distributions) {
    constexpr int kGrid = 1 << guiding::kMaxQuadtreeDepth;
    double sum = 0;
    for (int x = 0; x < kGrid; ++x)
      for (int y = 0; y < kGrid; ++y)
        sum += double{d.pdf((Vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) / float{kGrid})};
    EXPECT_NEAR(sum / (double{kGrid} * kGrid), 1, 1e-5);
  }
}

// The false-alarm rate is 0.1 % per distribution.
TEST(DirectionalTree, SamplesHaveTheDensity) {
  for (const DirectionalDistribution& d : distributions_with_peaks()) {
    uint32_t k = 0;
    const auto sample = [&](Vec3& w) { return w = square_to_sphere(d.sample(random_point(k++ + 500'000))), true; };
    const auto pdf = [&](const Vec3& w) { return double{d.pdf(guiding::sphere_to_square(w))} / (4 * double{kPi}); };
    const test::ChiSquare result = test::chi_square_on_sphere(sample, pdf, 500'000);
    EXPECT_GT(result.p_value, 1e-3) << result.statistic << " of " << result.degrees;
    EXPECT_GT(result.degrees, 20);
  }
}

TEST(DirectionalTree, CellsHaveTheirProbabilities) {
  for (const DirectionalDistribution& d : distributions_with_peaks()) {
    constexpr int kGrid = 1 << guiding::kMaxQuadtreeDepth;
    std::array<double, guiding::kCells> sums{};
    for (int x = 0; x < kGrid; ++x)
      for (int y = 0; y < kGrid; ++y) {
        Vec2 p = (Vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) / float{kGrid};
        const double density = double{d.pdf(p)};
        sums[guiding::descend_to_cell(p)] += density / (double{kGrid} * kGrid);
      }
    for (size_t i = 0; i < guiding::kCells; ++i) EXPECT_NEAR(d.cell_probabilities()[i] / sums[i], 1, 1e-4) << i;
  }
  for (size_t i = 0; i < guiding::kCells; ++i) {
    Vec2 p = guiding::cell_corner(i) + 0.01f;
    EXPECT_EQ(guiding::descend_to_cell(p), i);
    EXPECT_NEAR(p.x, 0.04f, 1e-5f);
  }
}

// Samples are counted in 16 x 16 cells of the square, whose probabilities follow from those of the distribution. The
// false-alarm rate is 0.1 % per product.
TEST(CosineProduct, SamplesHaveTheDensity) {
  using guiding::ScatteredSide;
  constexpr int kRows = 16, kGrid = 1 << guiding::kMaxQuadtreeDepth;
  constexpr uint32_t kSamples = 500'000;
  const auto cell_of = [](Vec2 p) {
    return static_cast<size_t>(p.x * kRows) + kRows * static_cast<size_t>(p.y * kRows);
  };
  const Vec3 normal = glm::normalize(Vec3(0.3f, -0.8f, 0.5f));
  const Vec3 tangent = glm::normalize(glm::cross(normal, Vec3(0, 0, 1)));
  for (const DirectionalDistribution& d : distributions_with_peaks()) {
    std::vector<double> probabilities(size_t{kRows} * kRows);
    for (int x = 0; x < kGrid; ++x)
      for (int y = 0; y < kGrid; ++y) {
        const Vec2 p = (Vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) / float{kGrid};
        probabilities[cell_of(p)] += double{d.pdf(p)} / (double{kGrid} * kGrid);
      }
    for (const ScatteredSide side : {ScatteredSide::normal, ScatteredSide::both}) {
      guiding::CosineProduct product;
      product.set(d, normal, side);
      const auto factor = [&](const Vec3& w) { return product.factor(guiding::sphere_to_square(w)); };
      EXPECT_GT(factor(normal), 2 * factor(tangent));
      EXPECT_EQ(factor(-normal) > 0, side == ScatteredSide::both);
      std::vector<double> counts(probabilities.size()), expected;
      for (uint32_t k = 0; k < kSamples; ++k) ++counts[cell_of(product.sample(random_point(k + 500'000)))];
      for (size_t i = 0; i < counts.size(); ++i) {
        const Vec2 centre = (Vec2(static_cast<float>(i % kRows), static_cast<float>(i / kRows)) + 0.5f) / float{kRows};
        expected.push_back(kSamples * probabilities[i] * double{product.factor(centre)});
      }
      EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0), kSamples, 1e-4 * kSamples);
      const auto result = equations::chi_square_test(counts, expected);
      EXPECT_GT(result.p_value, 1e-3) << result.statistic << " of " << result.degrees;
      EXPECT_GT(result.degrees, 20);
    }
  }
}

TEST(DirectionalTree, DensityIsPositiveWhereNothingWasFound) {
  DirectionalSums sums;
  sums.add({0.1f, 0.1f}, 1);
  const DirectionalDistribution d = sums.distribution(4);
  EXPECT_FLOAT_EQ(d.pdf({0.1f, 0.1f}), 4 * 5.0f / 8);
  EXPECT_FLOAT_EQ(d.pdf({0.9f, 0.9f}), 4 * 1.0f / 8);
}

TEST(DirectionalTree, RejectsNodesThatAreNoTree) {
  EXPECT_FALSE(guiding::is_quadtree({}));
  std::vector<guiding::QuadtreeNode> nodes(2);
  EXPECT_TRUE(guiding::is_quadtree(nodes));
  nodes[1].child[0] = 1;
  EXPECT_FALSE(guiding::is_quadtree(nodes));
  nodes[1].child[0] = 7;
  EXPECT_FALSE(guiding::is_quadtree(nodes));
}

// Records of uniformly distributed directions: bright for one half of the space from above, for the other from below.
void learn(RadianceGuide& guide, int iterations, uint32_t count, float slope = 0) {
  for (int i = 0; i < iterations; ++i) {
    for (uint32_t k = 0; k < count; ++k) {
      const Vec2 p = random_point(k + count * static_cast<uint32_t>(i));
      const Vec3 position(to_unit_float(hash_combine(3, k)) * 4 - 2, 0.5f, 0.5f);
      const bool bright = (p.x < 0.25f) == (position.x > 0);
      guide.add({guide.region_at(position), p, bright ? 1.0f : 0.01f, slope, std::abs(slope)});
    }
    guide.end_iteration(1000);
  }
}

RadianceGuide empty_guide() { return {Vec3(-2, 0, 0), Vec3(4, 1, 1), true, 0.5f}; }

TEST(RadianceGuide, LearnsWhereLightComesFrom) {
  RadianceGuide guide = empty_guide();
  EXPECT_FALSE(guide.region(0).is_ready());
  learn(guide, 3, 20'000);
  EXPECT_GE(guide.region_count(), 16u);
  const auto& right = guide.region(guide.region_at({1, 0.5f, 0.5f}));
  const auto& left = guide.region(guide.region_at({-1, 0.5f, 0.5f}));
  EXPECT_GT(right.guide.pdf({0.1f, 0.5f}), 20 * right.guide.pdf({0.6f, 0.5f}));
  EXPECT_GT(left.guide.pdf({0.6f, 0.5f}), 20 * left.guide.pdf({0.1f, 0.5f}));
  // The mean radiance of all directions, which are uniform with the density 1 on the square.
  EXPECT_NEAR(right.flux, 0.25 + 0.75 * 0.01, 0.03);
}

// Positions outside of the bounds, as of objects that move, belong to the nearest region.
TEST(RadianceGuide, PositionsOutsideHaveARegion) {
  RadianceGuide guide = empty_guide();
  learn(guide, 2, 20'000);
  for (const float far : {-1e30f, 1e30f, kInfinity}) EXPECT_LT(guide.region_at({far, far, -far}), guide.region_count());
}

TEST(RadianceGuide, FractionFollowsItsDerivative) {
  for (const float slope : {-0.5f, 0.5f}) {
    RadianceGuide guide = empty_guide();
    learn(guide, 5, 2000, slope);
    EXPECT_FLOAT_EQ(guide.region(0).fraction, slope < 0 ? RadianceGuide::kMinFraction : RadianceGuide::kMaxFraction);
  }
}

TEST(RadianceGuide, StateIsRestored) {
  RadianceGuide guide = empty_guide(), restored = empty_guide();
  learn(guide, 2, 20'000, 0.1f);
  StateWriter out;
  guide.write(out);
  const std::vector<std::byte> state = out.take();
  StateReader in(state);
  ASSERT_TRUE(restored.read(in));
  EXPECT_TRUE(in.at_end());
  learn(guide, 1, 20'000);
  learn(restored, 1, 20'000);
  StateWriter a, b;
  guide.write(a);
  restored.write(b);
  EXPECT_EQ(a.take(), b.take());
  // Bytes that are cut off are rejected.
  for (size_t size = 0; size < state.size(); size += state.size() / 50) {
    StateReader part({state.data(), size});
    RadianceGuide other = empty_guide();
    EXPECT_FALSE(other.read(part) && part.at_end());
  }
}

TEST(BlockRecords, AddsEveryRecordOnce) {
  RadianceGuide guide = empty_guide();
  learn(guide, 3, 20'000);
  std::vector<Record> records;
  std::vector<uint64_t> counts(guide.region_count());
  for (uint32_t k = 0; k < 5000; ++k) {
    const auto region = hash_combine(4, k) % static_cast<uint32_t>(counts.size());
    records.push_back({region, random_point(k), 1, 0, 0});
    ++counts[region];
  }
  guiding::BlockRecords block;
  block.assign(records);
  for (int group = 0; group < guiding::BlockRecords::kGroups; ++group) block.add_to(guide, group);
  for (uint32_t i = 0; i < counts.size(); ++i) EXPECT_EQ(guide.region(i).records, counts[i]);
}

}  // namespace
}  // namespace etendue
