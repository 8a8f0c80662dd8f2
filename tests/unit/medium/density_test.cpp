// Densities on grids: interpolation, bounds of coarse cells, traversal, integrals along rays, the registry.
#include <gtest/gtest.h>

#include <cmath>

#include "medium/density_field.h"
#include "medium/random_stream.h"

namespace etendue {
namespace {

template <class F>
DensityGrid grid_of(const GridSize& nodes, F&& density) {
  GridValues values{nodes, {}, {}};
  for (int z = 0; z < nodes[2]; ++z)
    for (int y = 0; y < nodes[1]; ++y)
      for (int x = 0; x < nodes[0]; ++x)
        values.density.push_back(
            static_cast<float>(density(Vec3(x, y, z) / Vec3(nodes[0] - 1, nodes[1] - 1, nodes[2] - 1))));
  return DensityGrid(std::move(values));
}

Vec3 random_point(RandomStream& random) {
  const float x = random.next(), y = random.next();
  return {x, y, random.next()};
}

// A ray that crosses the unit cube between two random points around it.
GridRay random_ray(RandomStream& random) {
  const Vec3 a = 3.0f * random_point(random) - Vec3(1), b = random_point(random);
  return DensityGrid::clipped({a, b - a, 0, 2});
}

TEST(Grid, InterpolatesLinearFunctionsExactly) {
  const auto linear = [](const Vec3& p) { return 1 + 2 * p.x + 3 * p.y + 5 * p.z; };
  const DensityGrid grid = grid_of({4, 7, 3}, linear);
  RandomStream random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random_point(random);
    EXPECT_NEAR(grid.density(p), linear(p), 1e-5f);
  }
  EXPECT_EQ(grid.density(Vec3(-1)), grid.density(Vec3(0)));
  EXPECT_NEAR(grid.highest(), 11, 1e-5f);
}

// Parts are adjacent, cover the ray, and bound the density.
TEST(Grid, CellsCoverARayAndBoundTheDensity) {
  RandomStream random(2);
  const DensityGrid grid = grid_of({41, 2, 70}, [&](const Vec3&) { return random.next(); });
  for (int i = 0; i < 2000; ++i) {
    const GridRay ray = random_ray(random);
    float at = ray.from;
    grid.for_each_cell(ray, [&](float from, float to, const DensityGrid::Cell& cell) {
      EXPECT_EQ(from, at);
      EXPECT_LT(from, to);
      at = to;
      for (const float t : {0.01f, 0.5f, 0.99f}) {
        const float density = grid.density(ray.at(from + t * (to - from)));
        EXPECT_LE(density, cell.highest * 1.0001f + 1e-4f);
        EXPECT_GE(density, cell.lowest * 0.9999f - 1e-4f);
      }
      return true;
    });
    EXPECT_EQ(at, ray.from < ray.to ? ray.to : ray.from);
  }
}

// The means of the cells along a ray through all of a linear density integrate it.
TEST(Grid, CellsHaveTheMeanDensity) {
  RandomStream random(3);
  const DensityGrid grid = grid_of({41, 12, 70}, [&](const Vec3& p) { return 1 + 2 * p.x + 3 * p.y + 5 * p.z; });
  for (int i = 0; i < 200; ++i) {
    const GridRay ray = random_ray(random);
    grid.for_each_cell(ray, [&](float, float, const DensityGrid::Cell& cell) {
      EXPECT_NEAR(cell.mean, 0.5f * (cell.lowest + cell.highest), 1e-4f);
      return true;
    });
  }
  // All cells have the same size along the second axis.
  const DensityGrid noise = grid_of({3, 33, 2}, [&](const Vec3&) { return random.next(); });
  double sum = 0, nodes = 0;
  noise.for_each_cell(DensityGrid::clipped({{0.25f, 0, 0.5f}, {0, 1, 0}, 0, 1}),
                      [&](float from, float to, const DensityGrid::Cell& cell) {
                        sum += static_cast<double>(cell.mean * (to - from));
                        nodes += static_cast<double>(to - from);
                        return true;
                      });
  EXPECT_NEAR(nodes, 1, 1e-5);
  EXPECT_NEAR(sum, noise.integral(DensityGrid::clipped({{0.25f, 0, 0.5f}, {0, 1, 0}, 0, 1})), 1e-4);
}

TEST(Grid, TraversalOfRaysAlongAxesAndEdges) {
  const DensityGrid grid = grid_of({33, 33, 33}, [](const Vec3&) { return 1; });
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {0.0f, 0.25f, 0.5f, 1.0f})
      for (const float sign : {1.0f, -1.0f}) {
        Vec3 origin(side), direction(0);
        origin[axis] = sign > 0 ? -1.0f : 2.0f;
        direction[axis] = sign;
        EXPECT_NEAR(grid.integral(DensityGrid::clipped({origin, direction, 0, kInfinity})), 1, 1e-5);
      }
  const Vec3 diagonal = glm::normalize(Vec3(1));
  EXPECT_NEAR(grid.integral(DensityGrid::clipped({Vec3(0), diagonal, 0, kInfinity})), std::sqrt(3.0), 1e-5);
  EXPECT_EQ(grid.integral(DensityGrid::clipped({Vec3(2), diagonal, 0, kInfinity})), 0);
}

TEST(Grid, IntegralsAlongRays) {
  const DensityGrid grid = grid_of({9, 9, 9}, [](const Vec3& p) { return p.x * 2 + p.y; });
  RandomStream random(3);
  for (int i = 0; i < 300; ++i) {
    const GridRay ray = random_ray(random);
    if (!(ray.from < ray.to)) continue;
    const Vec3 middle = ray.at(0.5f * (ray.from + ray.to));
    EXPECT_NEAR(grid.integral(ray), (middle.x * 2 + middle.y) * (ray.to - ray.from), 1e-4);
  }
}

TEST(Densities, AreFiniteAndNotNegative) {
  for (const DensityInfo& info : density_infos()) {
    const std::string name = info.description.name;
    if (name == "file") continue;
    const auto density = make_density(name);
    ASSERT_TRUE(density) << name;
    const auto& grid = density->grid();
    ASSERT_TRUE(grid) << name;
    EXPECT_GT((*grid)->highest(), 0) << name;
    EXPECT_LE((*grid)->highest(), 1) << name;
    RandomStream random(4);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 p = random_point(random);
      const float value = (*grid)->density(p), temperature = (*grid)->temperature(p);
      EXPECT_TRUE(std::isfinite(value) && value >= 0) << name;
      EXPECT_TRUE(temperature >= 0 && temperature <= 1.0001f) << name;
    }
  }
}

TEST(Densities, HaveParametersAndErrors) {
  const auto cloud = make_density("cloud", {{"frequency", 3.0}, {"seed", int64_t{7}}});
  ASSERT_TRUE(cloud);
  EXPECT_EQ(DensityRef{*cloud}, DensityRef{*make_density("cloud", {{"seed", int64_t{7}}, {"frequency", 3.0}})});
  EXPECT_FALSE(DensityRef{*cloud} == DensityRef{make_density("cloud")});
  EXPECT_FALSE(DensityRef{*cloud} == DensityRef{});
  EXPECT_FALSE(make_density("cloud", {{"frequency", -3.0}}));
  EXPECT_FALSE(make_density("cloud", {{"size", 3.0}}));
  EXPECT_NE(make_density("steam", {}).error().message.find("constant"), std::string::npos);
  const auto without_name = make_density("file");
  const auto& missing = without_name->grid();
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("set its parameter 'file'"), std::string::npos);
}

TEST(Densities, ExponentialFollowsTheBarometricFormula) {
  const auto density = make_density("exponential", {{"base", 0.1}, {"scale-height", 0.3}});
  ASSERT_TRUE(density);
  for (float h = 0.11f; h < 1; h += 0.07f)
    EXPECT_NEAR((*(*density)->grid())->density({0.5f, h, 0.5f}), std::exp(-(h - 0.1f) / 0.3f), 2e-5f);
}

}  // namespace
}  // namespace etendue
