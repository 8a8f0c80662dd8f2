// Tables and worked values of chapter 7 of the thesis: digital nets from generator matrices, one-dimensional discrepancies,
// correlations of late Halton dimensions, points on the sphere, and an integrand with an edge
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "base/vec.h"
#include "patterns/discrepancy.h"
#include "patterns/known_sets.h"
#include "patterns/net_quality.h"
#include "sampling/halton.h"

namespace etendue::patterns {
namespace {

// Rows of a generator matrix over the field of two elements, the digit of 1/2 first. Bit j of a row belongs to digit j of
// the point's number, the least significant one first.
using BinaryMatrix = std::vector<uint32_t>;

double digital_coordinate(uint32_t i, const BinaryMatrix& rows) {
  double x = 0, weight = 0.5;
  for (const uint32_t row : rows) {
    x += std::popcount(row & i) % 2 * weight;
    weight /= 2;
  }
  return x;
}

BinaryMatrix identity(uint32_t m) {
  BinaryMatrix rows;
  for (uint32_t k = 0; k < m; ++k) rows.push_back(1U << k);
  return rows;
}
BinaryMatrix anti_diagonal(uint32_t m) {
  BinaryMatrix rows = identity(m);
  std::ranges::reverse(rows);
  return rows;
}

PointSet digital_net(const BinaryMatrix& one, const BinaryMatrix& two) {
  return point_set(1U << one.size(), [&](uint32_t i) {
    return PlanePoint{digital_coordinate(i, one), digital_coordinate(i, two)};
  });
}

TEST(DigitalNets, TheNetOfTwoMatricesIsTheTabulatedOne) {  // [Lang, table 7.2]
  const PointSet expected{{0, 0},           {1. / 2, 1. / 8}, {1. / 4, 2. / 8}, {3. / 4, 3. / 8},
                          {1. / 8, 4. / 8}, {5. / 8, 5. / 8}, {3. / 8, 6. / 8}, {7. / 8, 7. / 8}};
  const PointSet net = digital_net(identity(3), anti_diagonal(3));
  EXPECT_EQ(net, expected);
  EXPECT_EQ(net_quality(net, 2), 0);
}

TEST(DigitalNets, QualityFollowsFromTheMatrices) {
  for (uint32_t m = 2; m <= 6; ++m) {
    EXPECT_EQ(net_quality(digital_net(identity(m), identity(m)), 2), static_cast<int>(m) - 1) << m;
    EXPECT_EQ(net_quality(digital_net(identity(m), anti_diagonal(m)), 2), 0) << m;
  }
  // The Pascal matrix modulo 2, and the anti-diagonal with its first two rows exchanged: a (1, 4, 2)-net.
  const PointSet pascal = digital_net(identity(3), {0b111, 0b010, 0b100});
  EXPECT_EQ(net_quality(pascal, 2), 0);
  EXPECT_EQ(pascal[2], (PlanePoint{1. / 4, 3. / 4}));
  EXPECT_EQ(pascal[5], (PlanePoint{5. / 8, 1. / 8}));
  const PointSet exchanged = digital_net(identity(4), {0b0100, 0b1000, 0b0010, 0b0001});
  EXPECT_EQ(net_quality(exchanged, 2), 1);
  EXPECT_EQ(exchanged[1], (PlanePoint{1. / 2, 1. / 16}));
  EXPECT_EQ(exchanged[4], (PlanePoint{1. / 8, 1. / 2}));
}

// The star discrepancy of sorted points of the unit interval [Niederreiter 1992, thm. 2.6].
double line_discrepancy(std::vector<double> points) {
  std::ranges::sort(points);
  const auto n = static_cast<double>(points.size());
  double largest = 0;
  for (size_t i = 0; i < points.size(); ++i)
    largest = std::max(largest, std::abs(points[i] - (2 * static_cast<double>(i) + 1) / (2 * n)));
  return 1 / (2 * n) + largest;
}

TEST(LineDiscrepancy, HasItsExactValues) {
  const auto van_der_corput = [](uint32_t n) {
    std::vector<double> points;
    for (uint32_t i = 0; i < n; ++i) points.push_back(HaltonSampler::radical_inverse(i, 2));
    return line_discrepancy(points);
  };
  const std::pair<uint32_t, double> expected[] = {{2, 1. / 2},   {3, 1. / 2},     {4, 1. / 4},
                                                  {5, 7. / 20},  {7, 1. / 4},     {8, 1. / 8},
                                                  {16, 1. / 16}, {21, 13. / 112}, {85, 199. / 5440}};
  for (const auto& [n, value] : expected) EXPECT_NEAR(van_der_corput(n), value, 1e-14) << n;
  for (const int n : {1, 4, 9}) {
    std::vector<double> centred;
    for (int i = 0; i < n; ++i) centred.push_back((i + 0.5) / n);
    EXPECT_NEAR(line_discrepancy(centred), 1 / (2.0 * n), 1e-15);
  }
}

// Pearson's correlation and the star discrepancy of 256 points in two bases, without and with Faure's permutations. The
// tabulated values have four digits.
TEST(HaltonPairs, CorrelationsAreTheTabulatedOnes) {
  struct Row {
    uint32_t base_x, base_y;
    double correlation, permuted_correlation, discrepancy, permuted_discrepancy;
  };
  const Row rows[] = {{17, 19, -0.0267, -0.0658, 0.0539, 0.0281},
                      {23, 29, 0.0481, 0.0080, 0.0629, 0.0312},
                      {67, 71, 0.4733, 0.1101, 0.2307, 0.0470},
                      {109, 113, 0.7501, -0.0555, 0.2976, 0.0246}};
  const auto correlation = [](const PointSet& set) {
    const auto n = static_cast<double>(set.size());
    double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    for (const auto& [a, b] : set) {
      x += a / n;
      y += b / n;
      xx += a * a / n;
      yy += b * b / n;
      xy += a * b / n;
    }
    return (xy - x * y) / std::sqrt((xx - x * x) * (yy - y * y));
  };
  for (const Row& row : rows) {
    const PointSet plain = halton_points(256, row.base_x, row.base_y);
    const auto one = HaltonSampler::faure_permutation(row.base_x), two = HaltonSampler::faure_permutation(row.base_y);
    const PointSet permuted = point_set(256, [&](uint32_t i) {
      return PlanePoint{HaltonSampler::radical_inverse(i, one), HaltonSampler::radical_inverse(i, two)};
    });
    EXPECT_NEAR(correlation(plain), row.correlation, 6e-5) << row.base_x;
    EXPECT_NEAR(correlation(permuted), row.permuted_correlation, 6e-5) << row.base_x;
    EXPECT_NEAR(star_discrepancy(plain), row.discrepancy, 6e-5) << row.base_x;
    EXPECT_NEAR(star_discrepancy(permuted), row.permuted_discrepancy, 6e-5) << row.base_x;
  }
}

// 1000 points at the angle 2 pi (i + 1/2) / N and the height 2 Phi_p(i) - 1 on the unit sphere          [Lang, eq. 7.44-7.46]
TEST(SphericalHammersley, MomentsAndDistancesAreTheTabulatedOnes) {
  struct Row {
    uint32_t base;
    double mean_distance, least_distance;
  };
  const Row rows[] = {
      {2, 0.08253, 0.01974}, {3, 0.09051, 0.0240}, {5, 0.08802, 0.0305}, {7, 0.06487, 0.0363}, {11, 0.06174, 0.0478}};
  constexpr uint32_t kPoints = 1000;
  for (const Row& row : rows) {
    std::vector<std::array<double, 3>> points;
    for (uint32_t i = 0; i < kPoints; ++i) {
      const double z = 2 * HaltonSampler::radical_inverse(i, row.base) - 1,
                   angle = 2 * std::numbers::pi * (i + 0.5) / kPoints;
      const double r = std::sqrt(1 - z * z);
      points.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
    std::array<double, 3> squares{};
    double sum = 0, least = 2;
    for (size_t i = 0; i < points.size(); ++i) {
      double nearest = 2;
      for (size_t j = 0; j < points.size(); ++j)
        if (i != j)
          nearest = std::min(nearest, std::hypot(points[i][0] - points[j][0], points[i][1] - points[j][1],
                                                 points[i][2] - points[j][2]));
      sum += nearest / kPoints;
      least = std::min(least, nearest);
      for (size_t axis = 0; axis < 3; ++axis) squares[axis] += sqr(points[i][axis]) / kPoints;
    }
    for (const double s : squares) EXPECT_NEAR(s, 1.0 / 3, 1e-3) << row.base;
    EXPECT_NEAR(sum, row.mean_distance, 6e-6) << row.base;
    EXPECT_NEAR(least, row.least_distance, 6e-5) << row.base;
  }
}

// The integral of [x < y] is 1/2. Its variation is infinite: N = 4^k points of the Hammersley set are not better than a
// regular grid.
TEST(Hammersley, DiagonalEdgesAreNoBetterThanOnAGrid) {
  const auto below_edge = [](const PointSet& set) {
    const auto count = std::ranges::count_if(set, [](const PlanePoint& p) { return p[0] < p[1]; });
    return static_cast<double>(count) / static_cast<double>(set.size());
  };
  for (const uint32_t side : {2U, 4U, 8U, 16U, 32U}) {
    const double expected = 0.5 - 1 / (2.0 * side);
    EXPECT_NEAR(below_edge(hammersley_points(side * side)), expected, 1e-12) << side;
    EXPECT_NEAR(below_edge(regular_grid_points(side)), expected, 1e-12) << side;
  }
}

// Without the digits after the last one, the inverses of [Lang, eq. 7.48] collide: the discrepancy is larger.
TEST(Zaremba, CutDigitsMakeTheSetWorse) {
  const auto cut_inverse = [](uint32_t i, uint32_t base) {
    double sum = 0, weight = 1;
    for (uint32_t j = 0; i > 0; ++j, i /= base) {
      weight /= base;
      sum += weight * ((i % base + j) % base);
    }
    return sum;
  };
  for (const auto& [count, exact, cut] : {std::tuple{64U, 0.057190, 0.0978}, {256U, 0.019223, 0.0324}}) {
    EXPECT_NEAR(star_discrepancy(zaremba_points(count)), exact, 1e-6);
    const PointSet set = point_set(count, [&](uint32_t i) { return PlanePoint{cut_inverse(i, 2), cut_inverse(i, 3)}; });
    EXPECT_NEAR(star_discrepancy(set), cut, 6e-5);
  }
}

}  // namespace
}  // namespace etendue::patterns
