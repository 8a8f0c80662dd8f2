// Environment maps: interpolation between texels, and the sampling density.
#include "light/sampling/environment_map.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "base/warp.h"
#include "support/chi_square.h"

namespace etendue::environment_map_test {
namespace {

Environment environment(int width, int height, const std::function<Rgb(int x, int y)>& texel) {
  auto map = std::make_shared<image::Image>();
  map->width = width;
  map->height = height;
  map->channels = 3;
  map->type = image::PixelType::float32;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) map->floats.push_back(texel(x, y)[c]);
  Environment e;
  e.map = map;
  e.tint = Rgb(1);
  return e;
}

// A dark map with one bright texel, like the sun.
Environment one_bright_texel(int at_x, int at_y) {
  return environment(16, 8, [&](int x, int y) { return Rgb(x == at_x && y == at_y ? 1000.0f : 0.001f); });
}

Environment noise(int width, int height) {
  return environment(width, height, [](int x, int y) {
    const auto n = static_cast<float>((x * 7 + y * 13) % 11);
    return Rgb(n, n * 0.5f, 11 - n);
  });
}

Vec3 direction_at(float u, float v) {
  const float theta = v * kPi;
  const float phi = (u - 0.5f) * 2 * kPi;
  return {std::cos(phi) * std::sin(theta), std::cos(theta), std::sin(phi) * std::sin(theta)};
}

// A low-discrepancy sequence in the unit square (R2).
Vec2 spread(int i) {
  const double a = 0.7548776662466927 * (i + 0.5);
  const double b = 0.5698402909980532 * (i + 0.5);
  return {static_cast<float>(a - std::floor(a)), static_cast<float>(b - std::floor(b))};
}

TEST(EnvironmentMap, EqualsTheTexelAtItsCentre) {
  const EnvironmentMap map(environment(8, 4, [](int x, int y) { return Rgb(static_cast<float>(10 * y + x)); }));
  EXPECT_NEAR(map.radiance(direction_at(5.5f / 8, 2.5f / 4)).r, 25, 1e-3f);
}

TEST(EnvironmentMap, InterpolatesBetweenTexels) {
  const EnvironmentMap map(environment(8, 4, [](int x, int y) { return Rgb(static_cast<float>(10 * y + x)); }));
  EXPECT_NEAR(map.radiance(direction_at(5.75f / 8, 2.25f / 4)).r, 22.75f, 1e-3f);
}

TEST(EnvironmentMap, WrapsAroundWithoutASeam) {
  const EnvironmentMap map(environment(8, 4, [](int x, int) { return Rgb(x == 0 ? 1.0f : x == 7 ? 3.0f : 0.0f); }));
  EXPECT_NEAR(map.radiance(direction_at(0.0f, 0.5f)).r, 2, 1e-3f);
  EXPECT_NEAR(map.radiance(direction_at(0.25f / 8, 0.5f)).r, 1.5f, 1e-3f);
  EXPECT_NEAR(map.radiance(direction_at(1 - 0.25f / 8, 0.5f)).r, 2.5f, 1e-3f);
}

TEST(EnvironmentMap, RepeatsTheLastRowUpToThePole) {
  const EnvironmentMap map(environment(8, 4, [](int, int y) { return Rgb(static_cast<float>(y)); }));
  EXPECT_NEAR(map.radiance(direction_at(0.3f, 0.05f)).r, 0, 1e-3f);
  EXPECT_NEAR(map.radiance(direction_at(0.3f, 0.95f)).r, 3, 1e-3f);
}

// Chi-square test with a false-alarm rate of 0.05 % over all maps. Bright texels at the poles are excluded: the density
// per solid angle has no limit there and cannot be integrated over the cells of the test.
TEST(EnvironmentMap, SamplesWithItsDensity) {
  for (const Environment& e :
       {noise(5, 3), noise(16, 8), noise(1, 1), one_bright_texel(3, 2), one_bright_texel(0, 4)}) {
    const EnvironmentMap map(e);
    for (const bool compensated : {false, true}) {
      if (compensated && map.compensated_share() == 0) continue;
      std::mt19937 random(1);
      std::uniform_real_distribution<float> unit(0, kOneMinusEpsilon);
      const auto result = test::chi_square_on_sphere(
          [&](Vec3& d) {
            const float x = unit(random);
            d = map.sample(Vec2(x, unit(random)), compensated).direction;
            return true;
          },
          [&](const Vec3& d) { return map.pdf_solid_angle(d, compensated); }, 200000);
      EXPECT_GT(result.p_value, 1e-4) << e.map->width << " x " << e.map->height << ' ' << compensated;
    }
  }
}

// The share is the closed form for a map whose halves have the radiances 0 and 2 in longitude: mean 1, so half of the
// flux exceeds it. Interpolation between the halves has little weight in a wide map.
TEST(EnvironmentMap, CompensatedSamplesCoverWhatExceedsTheMean) {
  const EnvironmentMap map(environment(256, 8, [](int x, int) { return Rgb(x < 128 ? 0.0f : 2.0f); }));
  EXPECT_NEAR(map.compensated_share(), 0.5f, 0.01f);
  for (int i = 0; i < 1000; ++i) {
    const auto s = map.sample(spread(i), true);
    EXPECT_GT(map.radiance(s.direction).r, 0);  // at least one texel beside it is bright
    EXPECT_NEAR(map.pdf_solid_angle(s.direction, true), s.pdf_solid_angle, 1e-2f * s.pdf_solid_angle);
  }
  EXPECT_EQ(map.pdf_solid_angle(direction_at(0.25f, 0.5f), true), 0);
}

TEST(EnvironmentMap, NearlyUniformRadianceIsLeftToBsdfSamples) {
  Environment constant;
  constant.tint = Rgb(3);
  EXPECT_EQ(EnvironmentMap(constant).compensated_share(), 0);
  EXPECT_EQ(EnvironmentMap(constant).pdf_solid_angle({1, 0, 0}, true), 0);
  const EnvironmentMap map(environment(16, 8, [](int x, int) { return Rgb(x % 2 == 0 ? 1.0f : 1.02f); }));
  EXPECT_EQ(map.compensated_share(), 0);
  EXPECT_GT(map.pdf_solid_angle({1, 0, 0}), 0);
}

// A sun that has most of the flux takes all compensated samples: its radiance raises the mean above that of the sky.
TEST(EnvironmentMap, CompensatedSamplesFindTheSun) {
  Environment e = environment(16, 8, [](int x, int y) { return Rgb(1 + 0.1f * static_cast<float>((x + y) % 3)); });
  e.sun = SunDisk{.direction = {0, 1, 0}, .radiance = Rgb(1e5f), .angular_radius = 0.01f};
  const EnvironmentMap map(e);
  for (int i = 0; i < 100; ++i) {
    const auto s = map.sample(spread(i), true);
    EXPECT_GT(s.direction.y, std::cos(0.011f));
    EXPECT_NEAR(s.pdf_solid_angle * kPi * sqr(0.01f), 1, 1e-3f);
  }
}

TEST(EnvironmentMap, DensityOfASampleIsThatOfItsDirection) {
  const EnvironmentMap map(noise(16, 8));
  for (int i = 0; i < 1000; ++i) {
    const auto s = map.sample(spread(i));
    EXPECT_NEAR(map.pdf_solid_angle(s.direction), s.pdf_solid_angle, 1e-2f * s.pdf_solid_angle);
  }
}

// Next to the poles, where azimuths are inaccurate, all texels have the same value.
TEST(EnvironmentMap, RadianceOfASampleIsThatOfItsDirection) {
  for (const bool has_sun : {false, true}) {
    Environment e = environment(16, 8, [](int x, int y) {
      return y == 0 || y == 7 ? Rgb(1) : Rgb(static_cast<float>((x * 7 + y * 13) % 11), 2, 3);
    });
    e.rotation = 0.7f;
    if (has_sun) e.sun = SunDisk{.direction = {0, 1, 0}, .radiance = Rgb(100), .angular_radius = 0.05f};
    const EnvironmentMap map(e);
    for (int i = 0; i < 1000; ++i) {
      const auto s = map.sample(spread(i));
      const Rgb expected = map.radiance(s.direction);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(s.radiance[c], expected[c], 1e-4f * (1 + expected[c])) << has_sun;
    }
  }
}

TEST(EnvironmentMap, ValueIsRadianceAndDensity) {
  Environment e = noise(16, 8);
  e.sun = SunDisk{.direction = {0, 0, 1}, .radiance = Rgb(100), .angular_radius = 0.3f};
  const EnvironmentMap map(e);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 direction = direction_at(spread(i).x, spread(i).y);
    for (const bool compensated : {false, true}) {
      const auto value = map.value(direction, compensated);
      EXPECT_EQ(value.radiance, map.radiance(direction));
      EXPECT_EQ(value.pdf_solid_angle, map.pdf_solid_angle(direction, compensated));
    }
  }
}

TEST(EnvironmentMap, EstimatesItsIntegral) {
  const EnvironmentMap map(one_bright_texel(3, 2));
  double sampled = 0;
  double uniform = 0;
  constexpr int kSamples = 200000;
  for (int i = 0; i < kSamples; ++i) {
    const auto s = map.sample(spread(i));
    sampled += map.radiance(s.direction).g / s.pdf_solid_angle / kSamples;
    const Vec2 u = spread(i);
    uniform += map.radiance(direction_at(u.x, std::acos(1 - 2 * u.y) * kInvPi)).g * 4 * kPi / kSamples;
  }
  EXPECT_NEAR(sampled, uniform, 0.005 * uniform);
}

// Next to a bright texel the interpolated radiance of a dark texel is high as well, and the density must follow.
TEST(EnvironmentMap, RadianceOverDensityIsBounded) {
  const EnvironmentMap map(one_bright_texel(3, 2));
  double mean = 0;
  float largest = 0;
  constexpr int kSamples = 100000;
  for (int i = 0; i < kSamples; ++i) {
    const Vec2 u = spread(i);
    const Vec3 d = direction_at(u.x, u.y);
    if (const float pdf = map.pdf_solid_angle(d); pdf > 0) largest = std::max(largest, map.radiance(d).g / pdf);
    const auto s = map.sample(u);
    mean += map.radiance(s.direction).g / s.pdf_solid_angle / kSamples;
  }
  EXPECT_LT(largest, 2 * mean);
}

// Radiance up to the largest float: squares of such values overflow, densities do not.
TEST(EnvironmentMap, DensityIsIndependentOfScale) {
  const auto scaled = [](float scale) {
    return EnvironmentMap(environment(8, 4, [&](int x, int y) { return Rgb(scale * static_cast<float>(1 + x + y)); }));
  };
  const EnvironmentMap bright = scaled(3e37f);
  const EnvironmentMap dim = scaled(1);
  for (int i = 0; i < 100; ++i) {
    const auto a = bright.sample(spread(i));
    const auto b = dim.sample(spread(i));
    EXPECT_LT(glm::distance(a.direction, b.direction), 1e-4f);
    EXPECT_NEAR(a.pdf_solid_angle, b.pdf_solid_angle, 1e-3f * b.pdf_solid_angle);
  }
}

TEST(EnvironmentMap, UniformMapEqualsAConstant) {
  Environment e = environment(16, 8, [](int, int) { return Rgb(0.5f, 1, 2); });
  e.tint = Rgb(2, 3, 4);
  const EnvironmentMap map(e);
  e.map = nullptr;
  e.tint = Rgb(1, 3, 8);
  const EnvironmentMap constant(e);
  for (int i = 0; i < 100; ++i) {
    const Vec3 direction = map.sample(spread(i)).direction;
    EXPECT_EQ(direction, constant.sample(spread(i)).direction);
    EXPECT_EQ(map.radiance(direction), constant.radiance(direction));
    EXPECT_EQ(map.pdf_solid_angle(direction), constant.pdf_solid_angle(direction));
  }
  EXPECT_EQ(map.mean_radiance(), constant.mean_radiance());
}

// The luminance of a white diffuse surface that faces the light: the largest irradiance over pi of a few thousand
// orientations, from directions that are uniform over the sphere.
float brightest_white(const EnvironmentMap& map) {
  constexpr int kDirections = 40000, kNormals = 3000;
  std::vector<Vec3> directions;
  std::vector<float> luminances;
  for (int i = 0; i < kDirections; ++i) {
    directions.push_back(square_to_sphere(
        {(static_cast<float>(i) + 0.5f) / kDirections, std::fmod(0.618034f * static_cast<float>(i), 1.0f)}));
    luminances.push_back(luminance(map.radiance(directions.back())));
  }
  float brightest = 0;
  for (int n = 0; n < kNormals; n += 7) {
    double sum = 0;
    for (size_t i = 0; i < directions.size(); ++i)
      sum += luminances[i] * std::max(0.0f, glm::dot(directions[static_cast<size_t>(n)], directions[i]));
    brightest = std::max(brightest, static_cast<float>(4 * sum / kDirections));
  }
  return brightest;
}

// The backdrop replaces what camera rays see of a hidden environment: grey, brighter above, and 12 to 36 % of a white
// surface that faces the light. The light does not change.
TEST(EnvironmentMap, BackdropIsSeenButEmitsNoLight) {
  Environment e = environment(16, 8, [](int x, int y) { return Rgb(static_cast<float>(x + y), 3, 1); });
  const EnvironmentMap shown(e);
  e.visible = false;
  const EnvironmentMap hidden(e);
  EXPECT_FALSE(hidden.visible());
  e.backdrop = true;
  const EnvironmentMap map(e);
  EXPECT_TRUE(map.visible());
  EXPECT_EQ(map.seen_spectrum(), nullptr);
  constexpr float kTolerance = 0.05f;  // 26 orientations come this close to the brightest
  const float white = brightest_white(map);
  for (int i = 0; i < 100; ++i) {
    const Vec3 direction = shown.sample(spread(i)).direction;
    EXPECT_EQ(shown.seen_radiance(direction), shown.radiance(direction));
    EXPECT_EQ(map.radiance(direction), shown.radiance(direction));
    EXPECT_EQ(map.pdf_solid_angle(direction), shown.pdf_solid_angle(direction));
    const Rgb seen = map.seen_radiance(direction);
    EXPECT_EQ(seen, Rgb(seen.r));
    EXPECT_GE(seen.r, (1 - kTolerance) * 0.12f * white);
    EXPECT_LE(seen.r, 0.361f * white);
  }
  EXPECT_LT(map.seen_radiance({0, -1, 0}).r, map.seen_radiance({0, 1, 0}).r);
  e.visible = true;
  EXPECT_FALSE(EnvironmentMap(e).shows_backdrop()) << "a visible environment has none";
}

// A sun, which the map does not show, counts as light.
TEST(EnvironmentMap, TheBackdropFollowsTheSun) {
  Environment e;
  e.tint = Rgb(2);
  e.visible = false;
  e.backdrop = true;
  EXPECT_NEAR(EnvironmentMap(e).seen_radiance({0, 1, 0}).g, 0.36f * 2, 1e-5f);
  SunDisk sun;
  sun.direction = glm::normalize(Vec3(1, 2, 0.5f));
  sun.angular_radius = 0.01f;
  sun.radiance = Rgb(1e4f);
  e.sun = sun;
  const float irradiance = 1e4f * 2 * kPi * (1 - std::cos(0.01f));
  EXPECT_NEAR(EnvironmentMap(e).seen_radiance({0, 1, 0}).g, 0.36f * 2 * (1 + irradiance / kPi), 0.01f)
      << "the tint is that of map and sun";
}

TEST(EnvironmentMap, BlackMapHasNoDensity) {
  const EnvironmentMap map(environment(4, 2, [](int, int) { return Rgb(0); }));
  EXPECT_EQ(map.pdf_solid_angle(direction_at(0.3f, 0.4f)), 0);
  EXPECT_EQ(map.sample(Vec2(0.3f, 0.4f)).pdf_solid_angle, 0);
}

}  // namespace
}  // namespace etendue::environment_map_test
