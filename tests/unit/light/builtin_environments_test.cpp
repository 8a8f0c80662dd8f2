// The environments that the program computes.
#include "light/environments/builtin_environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "light/sampling/environment_map.h"

namespace etendue::builtin_environments_test {
namespace {

// The irradiance on a surface with this normal, divided by pi: the radiance of a white surface. By the midpoint rule.
Rgb white_radiance(const EnvironmentMap& map, const Vec3& normal) {
  constexpr int kRows = 256, kColumns = 512;
  double sum[3] = {};
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kColumns; ++x) {
      const float theta = (static_cast<float>(y) + 0.5f) / kRows * kPi;
      const float phi = (static_cast<float>(x) + 0.5f) / kColumns * 2 * kPi;
      const Vec3 direction(std::cos(phi) * std::sin(theta), std::cos(theta), std::sin(phi) * std::sin(theta));
      const float weight = std::max(glm::dot(direction, normal), 0.0f) * std::sin(theta);
      const Rgb radiance = map.radiance(direction);
      for (int c = 0; c < 3; ++c) sum[c] += static_cast<double>(radiance[c] * weight);
    }
  const double cell = (M_PI / kRows) * (2 * M_PI / kColumns) / M_PI;
  return {static_cast<float>(sum[0] * cell), static_cast<float>(sum[1] * cell), static_cast<float>(sum[2] * cell)};
}

EnvironmentMap map_of(const char* name) { return EnvironmentMap(make_environment(*find_builtin_environment(name))); }

TEST(BuiltinEnvironments, HaveDistinctNamesAndFinitePositiveRadiance) {
  std::set<std::string> names;
  for (const BuiltinEnvironment& builtin : builtin_environments()) {
    EXPECT_TRUE(names.insert(builtin.name).second) << builtin.name;
    EXPECT_EQ(find_builtin_environment(builtin.name), &builtin);
    const Environment environment = make_environment(builtin);
    EXPECT_FALSE(environment.black());
    if (!environment.map) continue;
    for (const float v : environment.map->floats) ASSERT_TRUE(std::isfinite(v) && v > 0) << builtin.name;
  }
  EXPECT_EQ(find_builtin_environment("cellar"), nullptr);
}

TEST(BuiltinEnvironments, MapIsMadeOnce) {
  const BuiltinEnvironment& studio = *find_builtin_environment("studio");
  EXPECT_EQ(make_environment(studio), make_environment(studio));
}

TEST(BuiltinEnvironments, UniformNeedsNoMap) {
  const Environment uniform = make_environment(*find_builtin_environment("uniform"));
  EXPECT_EQ(uniform.map, nullptr);
  EXPECT_EQ(uniform.tint, Rgb(1));
}

// The irradiance of the CIE overcast sky is 7 pi / 9 times the zenith radiance.
TEST(BuiltinEnvironments, OvercastSkyGivesAWhiteGroundRadianceOne) {
  const Rgb ground = white_radiance(map_of("overcast"), {0, 1, 0});
  EXPECT_NEAR(ground.g, 1, 0.005);
}

// What faces the camera is well exposed, and the walls behind it are darker than white and brighter than black.
TEST(BuiltinEnvironments, StudioExposesAWhiteObjectInFrontOfGreyWalls) {
  const EnvironmentMap studio = map_of("studio");
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0, 0.6f, 0.8f), Vec3(-0.6f, 0, 0.8f), Vec3(0.6f, 0, 0.8f)}) {
    const float y = luminance(white_radiance(studio, normal));
    EXPECT_GT(y, 0.5f) << normal.x << " " << normal.y;
    EXPECT_LT(y, 1.6f) << normal.x << " " << normal.y;
  }
  for (float azimuth = -60; azimuth <= 60; azimuth += 5)
    for (float elevation = -60; elevation <= 20; elevation += 5) {
      const float a = azimuth * kPi / 180, e = elevation * kPi / 180;
      const float y = luminance(studio.radiance({std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)}));
      EXPECT_GT(y, 0.1f) << azimuth << " " << elevation;
      EXPECT_LT(y, 0.4f) << azimuth << " " << elevation;
    }
}

}  // namespace
}  // namespace etendue::builtin_environments_test
