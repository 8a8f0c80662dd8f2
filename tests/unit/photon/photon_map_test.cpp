// Lookups of photons against brute force, and density estimation against its theory: E[(k - 1) / (pi r_k^2)] is the
// density, with relative standard deviation 1 / sqrt(k - 2) [Lang, eq. 9.127-9.134].
#include "integrator/photon/photon_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

#include "base/warp.h"
#include "integrator/photon/hilbert_curve.h"
#include "integrator/photon/kernel.h"

namespace etendue::photon {
namespace {

const Vec3 kUp(0, 1, 0);

class Numbers {
 public:
  explicit Numbers(uint32_t seed) : engine_(seed) {}
  float operator()() { return std::uniform_real_distribution<float>(0, 1)(engine_); }
  Vec2 pair() {
    const float x = (*this)();
    return {x, (*this)()};
  }

 private:
  std::mt19937 engine_;
};

Photon at(const Vec3& position, const Vec3& normal = kUp) { return {position, normal, normal, Rgb(1), 1}; }

std::vector<Photon> cloud(size_t count, uint32_t seed) {
  Numbers random(seed);
  std::vector<Photon> photons;
  for (size_t i = 0; i < count; ++i) {
    const Vec3 p(random(), random(), random());
    photons.push_back(at(p, random() < 0.7f ? kUp : -kUp));
  }
  return photons;
}

// Photons distributed uniformly over the unit square, facing up.
PhotonMap plate(size_t count, uint32_t seed) {
  Numbers random(seed);
  std::vector<Photon> photons;
  for (size_t i = 0; i < count; ++i) {
    const Vec2 p = random.pair();
    photons.push_back(at({p.x, 0, p.y}));
  }
  PhotonMap map;
  map.build(std::move(photons));
  return map;
}

std::vector<float> distances_by_force(const std::vector<Photon>& photons, const Vec3& from, const Vec3& normal) {
  std::vector<float> all;
  for (const Photon& p : photons) {
    const Vec3 d = p.position() - from;
    const bool level = std::abs(glm::dot(d, normal)) <= 0.5f * glm::length(d);
    if (level && glm::dot(p.normal(), normal) > 0.5f) all.push_back(glm::dot(d, d));
  }
  std::ranges::sort(all);
  return all;
}

std::vector<float> distances_of(const Neighbourhood& around) {
  std::vector<float> all;
  around.for_each([&](uint32_t, size_t, float distance2) { all.push_back(distance2); });
  std::ranges::sort(all);
  return all;
}

// Half a quantisation step in both coordinates is 1.22 steps on the octahedron, and a factor of sqrt(3) more in the
// middle of its faces.
TEST(Photon, PackedDirectionsAreAccurate) {
  Numbers random(1);
  const auto worst = [&](int bits) {
    float most = 0;
    for (int i = 0; i < 100'000; ++i) {
      const Vec3 v = square_to_sphere(random.pair());
      most = std::max(most, glm::length(v - unpack_direction(pack_direction(v, bits), bits)));
    }
    return most;
  };
  EXPECT_LT(worst(10), 4.3f / (1 << 10));
  EXPECT_LT(worst(15), 4.3f / (1 << 15));
  for (const Vec3& v : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1), Vec3(0, 0, 1)})
    EXPECT_LT(glm::length(v - unpack_direction(pack_direction(v, 10), 10)), 4.3f / (1 << 10));
}

TEST(Photon, BatchPackingEqualsSinglePacking) {
  constexpr size_t kCount = 75;  // not a multiple of the register width
  Numbers random(3);
  Vec3Lanes<80> v{};
  std::array<uint32_t, 80> packed{};
  for (size_t i = 0; i < kCount; ++i) v.set(i, square_to_sphere(random.pair()));
  pack_directions(v, kCount, 10, packed.data());
  for (size_t i = 0; i < kCount; ++i) EXPECT_EQ(packed[i], pack_direction(v[i], 10)) << i;
}

TEST(Photon, StoresItsValues) {
  Photon p({1, 2, 3}, {0, 0, 1}, {0, 1, 0}, Rgb(4, 5, 6), 17, 63);
  EXPECT_EQ(p.position(), Vec3(1, 2, 3));
  EXPECT_EQ(p.power(), Rgb(4, 5, 6));
  EXPECT_EQ(p.length(), 17);
  EXPECT_EQ(p.state(), 63);
  EXPECT_GT(p.normal().y, 0.9999f);
  EXPECT_GT(p.direction().z, 0.9999f);
  EXPECT_EQ(Photon({}, kUp, kUp, Rgb(1), 1000).length(), Photon::kMaxLength);
}

std::vector<std::array<float, 4>> sorted_values(size_t count, const std::function<Photon(size_t)>& photon) {
  std::vector<std::array<float, 4>> values;
  for (size_t i = 0; i < count; ++i) {
    const Photon p = photon(i);
    values.push_back({p.position().x, p.position().y, p.position().z, p.normal().y});
  }
  std::ranges::sort(values);
  return values;
}

// The cells of every coarser grid are visited one after another, each beside the one before.
TEST(HilbertCurve, VisitsNeighbours) {
  constexpr uint32_t kSide = 8, kCells = kSide * kSide * kSide;
  const Cube cube{{-1, 2, 0}, 4};
  Vec3Lanes<kCells> centers{};
  std::vector<uint64_t> positions(kCells);
  for (uint32_t i = 0; i < kCells; ++i) {
    const Vec3 cell(static_cast<float>(i % kSide), static_cast<float>(i / kSide % kSide),
                    static_cast<float>(i / kSide / kSide));
    centers.set(i, cube.corner + cube.size * (cell + 0.5f) / static_cast<float>(kSide));
  }
  find_hilbert_positions(cube, centers, kCells, positions.data());
  std::vector<size_t> order(kCells);
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::sort(order, {}, [&](size_t i) { return positions[i]; });
  for (size_t k = 0; k < kCells; ++k) {
    EXPECT_EQ(positions[order[k]] >> (kHilbertBits - 9), k);
    if (k == 0) continue;
    EXPECT_FLOAT_EQ(glm::distance(centers[order[k - 1]], centers[order[k]]), cube.size / kSide) << k;
  }
}

TEST(PhotonMap, LeavesHoldEveryPhotonOnce) {
  for (const size_t count : {1U, 2U, 15U, 16U, 17U, 32U, 33U, 100U, 1000U, 4095U, 4096U, 4097U, 5000U}) {
    const auto photons = cloud(count, 7);
    PhotonMap map;
    map.build(photons);
    ASSERT_EQ(map.size(), count);
    EXPECT_EQ(sorted_values(count, [&](size_t i) { return map[i]; }),
              sorted_values(count, [&](size_t i) { return photons[i]; }))
        << count;
  }
}

TEST(PhotonMap, NearestEqualBruteForce) {
  const auto photons = cloud(3000, 3);
  PhotonMap map;
  map.build(photons);
  Numbers random(4);
  Neighbourhood around;
  for (int i = 0; i < 200; ++i) {
    const Vec3 from = Vec3(random(), random(), random()) * 1.4f - 0.2f;
    const auto all = distances_by_force(photons, from, kUp);
    for (const size_t most : {2U, 17U, 100U}) {
      map.find_nearest(from, kUp, most, kInfinity, around);
      EXPECT_EQ(distances_of(around), std::vector<float>(all.begin(), all.begin() + static_cast<long>(most) - 1));
      EXPECT_EQ(around.radius2(), all[most - 1]);
    }
    const float limit = sqr(0.1f);
    const auto within = static_cast<long>(std::ranges::lower_bound(all, limit) - all.begin());
    map.find_nearest(from, kUp, 3000, limit, around);
    EXPECT_EQ(distances_of(around), std::vector<float>(all.begin(), all.begin() + within));
    EXPECT_EQ(around.radius2(), limit);
    std::vector<float> visited;
    map.find_within(from, kUp, limit, around);
    map.for_each(around, [&](const Photon&, float d2) { visited.push_back(d2); });
    std::ranges::sort(visited);
    EXPECT_EQ(visited, std::vector<float>(all.begin(), all.begin() + within));
  }
}

void expect_close(const Rgb& sum, const Rgb& expected) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], expected[c], 1e-5f * expected[c] + 1e-6f);
}

TEST(PhotonMap, SumsOfPowersEqualThoseOfTheVisitedPhotons) {
  Numbers random(5);
  Neighbourhood around;
  std::vector<Photon> photons;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 position(random(), 0.02f * random(), random());
    const Rgb power(random(), random(), random());
    photons.emplace_back(position, square_to_sphere(random.pair()), kUp, power, 1 + i % 7);
  }
  PhotonMap map;
  map.build(photons);
  for (int i = 0; i < 100; ++i) {
    const Vec3 from(random(), 0.01f, random());
    const float radius2 = sqr(0.3f * random());
    const LambertianSide side{.normal = kUp, .side = i % 2 == 0 ? 0.5f : -0.5f, .max_length = 2 + i % 9};
    const auto is_selected = [&](const Photon& photon) {
      return photon.direction().y * side.side > 0 && photon.length() <= side.max_length;
    };
    Rgb expected(0);
    map.find_within(from, kUp, radius2, around);
    map.for_each(around, [&](const Photon& photon, float) {
      if (is_selected(photon)) expected += photon.power();
    });
    expect_close(map.sum_of_powers(around, side), expected);
    map.find_nearest(from, kUp, 60, radius2, around);
    expected = Rgb(0);
    map.for_each(around, [&](const Photon& photon, float) {
      if (is_selected(photon)) expected += photon.power();
    });
    expect_close(map.sum_of_powers(around, side), expected);
  }
}

// Points that share a search find the same photons as by themselves.
TEST(PhotonMap, GroupsOfPointsFindTheSamePhotons) {
  const auto photons = cloud(5000, 12);
  PhotonMap map;
  map.build(photons);
  Numbers random(13);
  LeafGroup group;
  Neighbourhood alone, together;
  for (int i = 0; i < 50; ++i) {
    const Vec3 corner = Vec3(random(), random(), random()) * 1.2f - 0.1f;
    const float size = 0.2f * random(), radius = 0.02f + 0.3f * random();
    Bounds box;
    std::vector<Vec3> points;
    for (int k = 0; k < 10; ++k) {
      points.push_back(corner + size * Vec3(random(), random(), random()));
      box.extend(points.back());
    }
    map.find_leaves(box, sqr(radius), group);
    for (const Vec3& p : points) {
      const float radius2 = sqr(radius * random());
      map.find_within(p, kUp, radius2, alone);
      map.find_within(group, p, kUp, radius2, together);
      EXPECT_EQ(distances_of(together), distances_of(alone));
    }
  }
}

// Photons on a grid: many have equal coordinates and equal distances.
TEST(PhotonMap, NearestOfEqualDistancesEqualBruteForce) {
  std::vector<Photon> photons;
  for (int x = 0; x < 70; ++x)
    for (int z = 0; z < 70; ++z) photons.push_back(at({static_cast<float>(x), 0, static_cast<float>(z)}));
  PhotonMap map;
  map.build(photons);
  Neighbourhood around;
  for (int i = 0; i < 50; ++i) {
    const Vec3 from(static_cast<float>(i), 0, static_cast<float>(3 * i % 70));
    const auto all = distances_by_force(photons, from, kUp);
    for (const size_t most : {4U, 6U, 50U, 77U}) {
      map.find_nearest(from, kUp, most, kInfinity, around);
      EXPECT_EQ(distances_of(around), std::vector<float>(all.begin(), all.begin() + static_cast<long>(most) - 1));
      EXPECT_EQ(around.radius2(), all[most - 1]);
    }
  }
}

// The inner side of a far wall has the same normal as the outer side of the near wall.
TEST(PhotonMap, PhotonsStraightBehindBelongToAnotherSurface) {
  Neighbourhood around;
  PhotonMap map;
  const Vec3 beside = glm::normalize(glm::cross(kUp, Vec3(0.3f, 0.4f, 0.5f)));
  map.build({at(kUp), at(-kUp), at(beside)});
  map.find_nearest({0, 0, 0}, kUp, 10, 4, around);
  EXPECT_EQ(around.size(), 1U);
  int visited = 0;
  map.find_within({0, 0, 0}, kUp, 4, around);
  map.for_each(around, [&](const Photon& photon, float) {
    ++visited;
    EXPECT_GT(glm::dot(photon.position(), beside), 0.99f);
  });
  EXPECT_EQ(visited, 1);
}

TEST(PhotonMap, QueriesForMorePhotonsThanStored) {
  Neighbourhood around;
  PhotonMap map;
  map.build({});
  map.find_nearest({0, 0, 0}, kUp, 10, kInfinity, around);
  EXPECT_TRUE(around.empty());
  map.build({at({0, 0, 1})});
  map.find_nearest({0, 0, 0}, kUp, 10, kInfinity, around);
  EXPECT_TRUE(around.empty());
  map.find_nearest({0, 0, 0}, kUp, 10, 4, around);
  EXPECT_EQ(around.size(), 1U);
  map.build({at({0, 0, 1}), at({0, 0, 2}), at({0, 0, 2})});
  map.find_nearest({0, 0, 0}, kUp, 10, kInfinity, around);
  EXPECT_EQ(around.size(), 2U);
  EXPECT_EQ(around.radius2(), 4);
  map.find_nearest({0, 0, 0}, -kUp, 10, kInfinity, around);
  EXPECT_TRUE(around.empty());
}

TEST(PhotonMap, CoincidentPhotonsAreAllFound) {
  PhotonMap map;
  map.build(std::vector<Photon>(1000, at({1, 1, 1})));
  Neighbourhood around;
  map.find_nearest({1, 1, 1}, kUp, 2000, 1, around);
  EXPECT_EQ(around.size(), 1000U);
  map.find_nearest({1, 1, 1}, kUp, 100, 1, around);
  EXPECT_EQ(around.size(), 99U);
  EXPECT_EQ(distances_of(around), std::vector<float>(99, 0));
  int visited = 0;
  map.find_within({1, 1, 1}, kUp, 1e-6f, around);
  map.for_each(around, [&](const Photon&, float) { ++visited; });
  EXPECT_EQ(visited, 1000);
}

// The estimate from k - 1 photons over the disc of the k-th has the correct mean and a relative standard deviation of 1
// / sqrt(k - 2). Queries are so far apart that they share no photon. Tolerances: 4.5 standard errors for the mean, 10 %
// for the deviation, which is several standard errors.
TEST(Density, HasTheMeanAndTheDeviationOfTheory) {
  constexpr size_t kPhotons = 400'000;
  const PhotonMap map = plate(kPhotons, 5);
  Neighbourhood around;
  for (const size_t k : {10U, 50U, 100U}) {
    const float apart = 4 * std::sqrt(static_cast<float>(k) / (kPi * kPhotons));
    double sum = 0, squares = 0;
    int count = 0;
    for (float x = 2 * apart; x < 1 - 2 * apart; x += apart)
      for (float z = 2 * apart; z < 1 - 2 * apart; z += apart, ++count) {
        map.find_nearest({x, 0, z}, kUp, k, kInfinity, around);
        const double density = static_cast<double>(around.size()) / (double{kPi} * double{around.radius2()} * kPhotons);
        sum += density;
        squares += sqr(density);
      }
    const double mean = sum / count, deviation = std::sqrt(squares / count - sqr(mean));
    const double expected = 1 / std::sqrt(static_cast<double>(k) - 2);
    EXPECT_NEAR(mean, 1, 4.5 * expected / std::sqrt(count)) << k;
    EXPECT_NEAR(deviation, expected, 0.1 * expected) << k << ' ' << count;
  }
}

double density_at(const PhotonMap& map, const Vec3& position, size_t k, const Vec3& normal = kUp) {
  Neighbourhood around;
  map.find_nearest(position, normal, k, kInfinity, around);
  return static_cast<double>(around.size()) /
         (double{kPi} * double{around.radius2()} * static_cast<double>(map.size()));
}

// Boundary bias [Lang, Remark 9.32]: at an edge half of the disc lies beside the plate, at a corner three quarters. The
// noise is 1 %, the tolerance 4.5 %.
TEST(Density, IsHalvedAtAnEdgeAndQuarteredAtACorner) {
  constexpr size_t kNearest = 2500;
  double edge = 0, corner = 0;
  for (uint32_t seed = 0; seed < 2; ++seed) {
    const PhotonMap map = plate(200'000, 20 + seed);
    for (const Vec3& p : {Vec3(0, 0, 0.5f), Vec3(1, 0, 0.5f), Vec3(0.5f, 0, 0), Vec3(0.5f, 0, 1)})
      edge += density_at(map, p, kNearest) / 8;
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 1)})
      corner += density_at(map, p, kNearest) / 8;
  }
  EXPECT_NEAR(edge, 0.5, 0.0225);
  EXPECT_NEAR(corner, 0.25, 0.01125);
}

// A sphere of radius r around a point of a larger sphere cuts off a cap of area pi r^2 exactly, so there is no bias.
// 400 estimates with 4.5 % noise.
TEST(Density, HasNoBiasOnASphere) {
  Numbers random(9);
  std::vector<Photon> photons;
  for (int i = 0; i < 100'000; ++i) {
    const Vec3 p = square_to_sphere(random.pair());
    photons.push_back(at(p, p));
  }
  PhotonMap map;
  map.build(std::move(photons));
  double sum = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 p = square_to_sphere(random.pair());
    sum += density_at(map, p, 500, p) * 4 * double{kPi} / 400;
  }
  // Neighbouring estimates share photons; about 200 are independent.
  EXPECT_NEAR(sum, 1, 4.5 * 0.045 / std::sqrt(200));
}

TEST(Kernel, MeanOverTheDiscIsOne) {
  for (const Kernel kernel : {Kernel::constant, Kernel::cone, Kernel::gaussian}) {
    constexpr int kSteps = 100'000;
    double mean = 0;
    for (int i = 0; i < kSteps; ++i)
      mean += double{kernel_weight(kernel, (static_cast<float>(i) + 0.5f) / kSteps)} / kSteps;
    EXPECT_NEAR(mean, 1, 1e-3) << static_cast<int>(kernel);
    EXPECT_GE(kernel_weight(kernel, 0), kernel_weight(kernel, 1));
    EXPECT_GE(kernel_weight(kernel, 1), 0);
  }
}

}  // namespace
}  // namespace etendue::photon
