// Point sets and sequences: published values, stratification, distances, and the error of randomised sets.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/hash.h"
#include "patterns/distances.h"
#include "patterns/net_quality.h"
#include "sampling/halton.h"
#include "sampling/point_sets/faure.h"
#include "sampling/point_sets/hammersley.h"
#include "sampling/point_sets/hexagonal_grid.h"
#include "sampling/point_sets/lattice.h"
#include "sampling/point_sets/niederreiter.h"
#include "sampling/point_sets/poisson_disk.h"
#include "sampling/point_sets/zaremba.h"
#include "unit/sampling/points.h"

namespace etendue {
namespace {

using patterns::least_toroidal_distance, patterns::net_quality, patterns::toroidal_distance;
using Point = patterns::PlanePoint;

double fraction(uint32_t bits) { return bits * 0x1p-32; }

// Dimensions `first` and first + 1 of the samples of a sampler.
std::vector<Point> pairs(const Sampler& sampler, uint32_t seed, uint32_t count, size_t first) {
  std::vector<Point> result;
  for (const auto& p : test::points(sampler, seed, count, 1)) result.push_back({p[first], p[first + 1]});
  return result;
}

TEST(Hammersley, PublishedPointsAndNets) {
  EXPECT_EQ(fraction(HammersleySampler::point(6, 6)[0]), 3. / 32);
  EXPECT_EQ(fraction(HammersleySampler::point(6, 6)[1]), 3. / 8);
  for (int m = 0; m <= 8; ++m) {
    std::vector<Point> plain;
    for (uint32_t i = 0; i < 1U << m; ++i) {
      const auto p = HammersleySampler::point(i, m);
      plain.push_back({fraction(p[0]), fraction(p[1])});
    }
    EXPECT_EQ(net_quality(plain, 2), 0) << m;
  }
}

// Nested scrambling and digital shifts keep the net; jitter leaves one point in each of N rows and columns.
TEST(Hammersley, ScramblingKeepsTheNet) {
  constexpr int kLog2 = 6;
  const auto make = [](const char* scrambling) {
    return make_sampler("hammersley", {{"log2-size", int64_t{kLog2}}, {"scrambling", std::string(scrambling)}});
  };
  for (uint32_t seed = 0; seed < 20; ++seed)
    for (const size_t first : {0, 2}) {
      EXPECT_EQ(net_quality(pairs(*make("owen"), mix_bits(seed), 64, first), 2), 0);
      EXPECT_EQ(net_quality(pairs(*make("digital-shift"), mix_bits(seed), 64, first), 2), 0);
      const auto jittered = pairs(*make("jitter"), mix_bits(seed), 64, first);
      for (const size_t axis : {0, 1}) {
        std::set<int> filled;
        for (const Point& p : jittered) filled.insert(static_cast<int>(64 * p[axis]));
        EXPECT_EQ(filled.size(), 64U);
      }
    }
}

// Root mean square errors of the integral of exp(x + y) over 2000 randomisations, and those of random points. The
// expected values are known to 4 %, and those measured here to 2 %.
TEST(Hammersley, ErrorsOfRandomisedSets) {
  struct Row {
    const char* scrambling;        // empty: random points
    std::array<double, 3> errors;  // for 16, 64 and 256 points
  };
  const double exact = std::pow(std::exp(1.0) - 1, 2);
  for (const Row& row : {Row{"owen", {2.66e-2, 3.76e-3, 5.20e-4}}, Row{"rotation", {8.29e-2, 2.27e-2, 6.24e-3}},
                         Row{"", {0.313, 0.149, 0.0736}}})
    for (size_t k = 0; k < row.errors.size(); ++k) {
      const int log2_size = 4 + 2 * static_cast<int>(k);
      const uint32_t count = 1U << log2_size;
      const auto sampler = *row.scrambling ? make_sampler("hammersley", {{"log2-size", int64_t{log2_size}},
                                                                         {"scrambling", std::string(row.scrambling)}})
                                           : make_sampler("random");
      constexpr int kSets = 2000;
      double squares = 0;
      for (uint32_t seed = 0; seed < kSets; ++seed) {
        double sum = 0;
        for (const Point& p : pairs(*sampler, mix_bits(seed + 1), count, 0)) sum += std::exp(p[0] + p[1]);
        squares += std::pow(sum / count - exact, 2);
      }
      EXPECT_NEAR(std::sqrt(squares / kSets), row.errors[k], 0.15 * row.errors[k]) << row.scrambling << ' ' << count;
    }
}

TEST(Zaremba, PublishedValues) {
  const double two[] = {1. / 3, 5. / 6, 1. / 12, 7. / 12, 11. / 24, 23. / 24, 5. / 24, 17. / 24};
  for (uint32_t i = 0; i < 8; ++i) EXPECT_NEAR(ZarembaSampler::inverse(i, 2), two[i], 1e-14) << i;
  const double three[] = {5. / 26,    41. / 78,  67. / 78,  71. / 234, 149. / 234,
                          227. / 234, 19. / 234, 97. / 234, 175. / 234};
  for (uint32_t i = 0; i < 9; ++i) EXPECT_NEAR(ZarembaSampler::inverse(i, 3), three[i], 1e-14) << i;
}

TEST(FaurePermutations, PublishedValues) {
  using Permutation = std::vector<uint16_t>;
  EXPECT_EQ(HaltonSampler::faure_permutation(9), (Permutation{0, 5, 2, 7, 4, 1, 6, 3, 8}));
  EXPECT_EQ(HaltonSampler::faure_permutation(10), (Permutation{0, 6, 4, 2, 8, 1, 7, 5, 3, 9}));
  EXPECT_EQ(HaltonSampler::faure_permutation(13), (Permutation{0, 4, 9, 2, 7, 11, 6, 1, 5, 10, 3, 8, 12}));
  EXPECT_EQ(HaltonSampler::faure_permutation(23),
            (Permutation{0, 15, 8, 4, 19, 10, 2, 17, 13, 6, 21, 11, 1, 16, 9, 5, 20, 12, 3, 18, 14, 7, 22}));
  const double five[] = {0, 3. / 5, 2. / 5, 1. / 5, 4. / 5, 3. / 25, 18. / 25, 13. / 25, 8. / 25, 23. / 25, 2. / 25};
  const auto permutation = HaltonSampler::faure_permutation(5);
  for (uint32_t i = 0; i < 11; ++i) EXPECT_NEAR(HaltonSampler::radical_inverse(i, permutation), five[i], 1e-15) << i;
}

// The correlation of neighbouring late dimensions: 0.75 without scrambling.
TEST(FaurePermutations, RemoveTheCorrelationOfLateDimensions) {
  const auto correlation = [](auto&& inverse) {
    double sum = 0;
    for (uint32_t i = 0; i < 256; ++i) sum += 12 * (inverse(i, 109U) - 0.5) * (inverse(i, 113U) - 0.5) / 256;
    return sum;
  };
  EXPECT_GT(correlation([](uint32_t i, uint32_t b) { return HaltonSampler::radical_inverse(i, b); }), 0.6);
  EXPECT_LT(std::abs(correlation([](uint32_t i, uint32_t b) {
              return HaltonSampler::radical_inverse(i, HaltonSampler::faure_permutation(b));
            })),
            0.15);
}

// 121 successive points have one point in each cell of every pair of dimensions, and 121 intervals of each.
TEST(Faure, PairsOfDimensionsAreNets) {
  for (uint32_t first : {0U, 121U, 1210U})
    for (uint32_t a = 0; a < kBlockSize; ++a)
      for (uint32_t b = 0; b < a; ++b) {
        std::set<uint32_t> cells, intervals;
        for (uint32_t i = first; i < first + 121; ++i) {
          const auto x = FaureSampler::point(i, a), y = FaureSampler::point(i, b);
          cells.insert(x[0] * 11 + y[0]);
          intervals.insert(x[0] * 11 + x[1]);
        }
        EXPECT_EQ(cells.size(), 121U) << a << ' ' << b;
        EXPECT_EQ(intervals.size(), 121U) << a;
      }
}

// Dimensions 0 and 1 belong to the polynomials x and x + 1 of degree one. Every dimension by itself is a
// (0, 1)-sequence.
TEST(Niederreiter, IsADigitalSequence) {
  for (const uint32_t first : {0U, 64U, 640U}) {
    std::vector<Point> points;
    for (uint32_t i = first; i < first + 64; ++i)
      points.push_back({fraction(NiederreiterSampler::point(i, 0)), fraction(NiederreiterSampler::point(i, 1))});
    EXPECT_EQ(net_quality(points, 2), 0);
    for (uint32_t d = 0; d < NiederreiterSampler::kDimensions; ++d) {
      std::set<uint32_t> filled;
      for (uint32_t i = first; i < first + 64; ++i) filled.insert(NiederreiterSampler::point(i, d) >> 26);
      EXPECT_EQ(filled.size(), 64U) << d;
    }
  }
  // Dimension 2 (x^2 + x + 1) has t = 1.
  std::vector<Point> points;
  for (uint32_t i = 0; i < 256; ++i)
    points.push_back({fraction(NiederreiterSampler::point(i, 0)), fraction(NiederreiterSampler::point(i, 2))});
  EXPECT_LE(net_quality(points, 2), 1);
}

// The figure of merit P2, the squared worst-case error of smooth periodic functions, of pairs of dimensions: a tenth of
// the value that random points have on average.
TEST(Lattice, PairsOfDimensionsAreEven) {
  constexpr uint32_t kPoints = 1024;
  const auto kernel = [](double x) { return 1 + 2 * sqr(3.14159265358979) * (x * x - x + 1.0 / 6); };
  const double random = (sqr(kernel(0)) - 1) / kPoints;
  std::vector<double> merits;
  for (uint32_t a = 1; a < LatticeSampler::kDimensions; ++a) {
    double sum = 0;
    for (uint32_t i = 0; i < kPoints; ++i)
      sum += kernel(fraction(LatticeSampler::point(i, a - 1))) * kernel(fraction(LatticeSampler::point(i, a)));
    merits.push_back(sum / kPoints - 1);
  }
  std::ranges::sort(merits);
  EXPECT_GT(merits.front(), 0);
  EXPECT_LT(merits[merits.size() / 2], random / 10);
  EXPECT_LT(merits.back(), random);
}

double points_of(PoissonDiskSize size) {
  return size == PoissonDiskSize::small ? 16 : size == PoissonDiskSize::medium ? 64 : 256;
}

// The share of the square that is farther than `distance` from all points.
double share_of_holes(const std::vector<Point>& set, double distance) {
  constexpr int kProbes = 100;
  int free = 0;
  for (int i = 0; i < kProbes * kProbes; ++i) {
    const Point p{(i % kProbes + 0.5) / kProbes, (i / kProbes + 0.5) / kProbes};
    free += std::ranges::all_of(set, [&](const Point& q) { return toroidal_distance(p, q) >= distance; });
  }
  return free / double{kProbes * kProbes};
}

TEST(PoissonDisk, KeepsTheDistanceAndHasNoHoles) {
  for (const auto algorithm : {PoissonDiskAlgorithm::darts, PoissonDiskAlgorithm::bridson})
    for (const auto size : {PoissonDiskSize::small, PoissonDiskSize::medium, PoissonDiskSize::large}) {
      const auto& set = PoissonDiskSampler::points(size, algorithm);
      const double wanted = points_of(size);
      EXPECT_NEAR(static_cast<double>(set.points.size()), wanted, 0.15 * wanted);
      EXPECT_GE(least_toroidal_distance(set.points), set.distance);
      // Hardly any place is left for another point.
      EXPECT_LT(share_of_holes(set.points, set.distance), 0.005);
    }
}

// Any prefix of best candidates keeps a distance that is a large share of that of the hexagonal grid with as many points;
// random points come as close as 1/N on average.
TEST(PoissonDisk, PrefixesOfBestCandidatesAreEven) {
  for (const auto size : {PoissonDiskSize::small, PoissonDiskSize::medium, PoissonDiskSize::large}) {
    const auto& set = PoissonDiskSampler::points(size, PoissonDiskAlgorithm::best_candidate);
    EXPECT_EQ(static_cast<double>(set.points.size()), points_of(size));
    EXPECT_NEAR(least_toroidal_distance(set.points), set.distance, 1e-12);
    for (size_t count = 8; count <= set.points.size(); count *= 2) {
      const std::vector<Point> prefix(set.points.begin(), set.points.begin() + static_cast<std::ptrdiff_t>(count));
      const double largest = std::sqrt(2 / (std::sqrt(3.0) * static_cast<double>(count)));
      EXPECT_GT(least_toroidal_distance(prefix), 0.55 * largest) << count;
    }
  }
}

// The largest possible distance of N points on the torus is sqrt(2 / (sqrt(3) N)).
TEST(HexagonalGrid, HasTheLargestDistances) {
  for (const int columns : {4, 7, 15}) {
    const auto sampler = make_sampler("hexagonal-grid", {{"columns", int64_t{columns}}});
    const uint32_t count = static_cast<uint32_t>(columns) * HexagonalGridSampler::rows(static_cast<uint32_t>(columns));
    const double largest = std::sqrt(2 / (std::sqrt(3.0) * count));
    for (const size_t first : {0, 2}) {
      const double distance = least_toroidal_distance(pairs(*sampler, 77, count, first));
      EXPECT_LE(distance, largest * 1.0001);
      EXPECT_GT(distance, 0.85 * largest) << columns;
    }
  }
}

TEST(RegularGrid, IsAGrid) {
  const auto sampler = make_sampler("regular-grid", {{"side", int64_t{5}}});
  EXPECT_NEAR(least_toroidal_distance(pairs(*sampler, 3, 25, 0)), 0.2, 1e-6);
}

// Every dimension of a group has one point in each interval.
TEST(LatinHypercube, EveryDimensionIsStratified) {
  const auto sampler = make_sampler("latin-hypercube", {{"samples", int64_t{37}}});
  const auto p = test::points(*sampler, 9, 2 * 37, 2);
  for (const size_t first : {0, 37})
    for (size_t d = 0; d < p[0].size(); ++d) {
      std::set<int> filled;
      for (size_t s = first; s < first + 37; ++s) filled.insert(static_cast<int>(37 * double{p[s][d]} + 1e-5));
      EXPECT_EQ(filled.size(), 37U) << d;
    }
}

// The variance of a sum over s dimensions is s / (12 N^3).
TEST(LatinHypercube, RemovesTheVarianceOfSums) {
  constexpr uint32_t kSamples = 16;
  const auto sampler = make_sampler("latin-hypercube", {{"samples", int64_t{kSamples}}});
  constexpr int kSets = 4000;
  double squares = 0;
  for (uint32_t seed = 0; seed < kSets; ++seed) {
    double sum = 0;
    for (const Point& p : pairs(*sampler, mix_bits(seed + 5), kSamples, 0)) sum += p[0] + p[1] - 1;
    squares += sqr(sum / kSamples);
  }
  const double expected = 2 / (12 * std::pow(kSamples, 3));
  EXPECT_NEAR(squares / kSets, expected, 4.5 * std::sqrt(2.0 / kSets) * expected);
}

// All pairs of dimensions of a block have one point in each cell; every dimension has one in each interval.
TEST(OrthogonalArray, AllPairsAreStratified) {
  for (const int symbols : {7, 8, 13}) {
    const auto sampler = make_sampler("orthogonal-array", {{"symbols", int64_t{symbols}}});
    const int b = symbols == 8 ? 11 : symbols, size = b * b;
    const auto p = test::points(*sampler, 4, static_cast<uint32_t>(2 * size), 2);
    const auto cell = [&](size_t s, size_t d, int cells) { return static_cast<int>(cells * double{p[s][d]} + 1e-5); };
    for (const int first : {0, size})
      for (size_t d = 0; d < p[0].size(); ++d) {
        std::set<int> intervals;
        for (int s = first; s < first + size; ++s) intervals.insert(cell(static_cast<size_t>(s), d, size));
        EXPECT_EQ(intervals.size(), static_cast<size_t>(size)) << d;
        for (size_t e = d / kBlockSize * kBlockSize; e < d; ++e) {
          std::set<int> cells;
          for (int s = first; s < first + size; ++s)
            cells.insert(cell(static_cast<size_t>(s), d, b) * b + cell(static_cast<size_t>(s), e, b));
          EXPECT_EQ(cells.size(), static_cast<size_t>(size)) << d << ' ' << e;
        }
      }
  }
}

// N times the variance of xy + yz + xz, a sum of functions of pairs of dimensions.
TEST(OrthogonalArray, ReducesTheVarianceOfPairs) {
  const auto variance = [](const char* name, const std::vector<Setting>& settings) {
    const auto sampler = make_sampler(name, settings);
    constexpr int kSets = 3000;
    double squares = 0;
    for (uint32_t seed = 0; seed < kSets; ++seed) {
      double sum = 0;
      for (const auto& p : test::points(*sampler, mix_bits(seed + 1), 49, 1)) {
        const double x = p[0], y = p[1], z = p[2];
        sum += x * y + y * z + x * z - 0.75;
      }
      squares += sqr(sum / 49);
    }
    return 49 * squares / kSets;
  };
  const double random = variance("random", {}), hypercube = variance("latin-hypercube", {{"samples", int64_t{49}}}),
               array = variance("orthogonal-array", {{"symbols", int64_t{7}}});
  EXPECT_NEAR(random, 0.270, 0.04);
  EXPECT_NEAR(hypercube, 0.0213, 0.003);
  EXPECT_LT(array, 0.009);
}

}  // namespace
}  // namespace etendue
