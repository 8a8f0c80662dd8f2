// The physical sky, the disk of the sun, and environment portals.
#include "light/environments/sky.h"

#include <gtest/gtest.h>

#include <array>

#include <cmath>

#include "light/environments/hosek_sky.h"
#include "light/sampling/environment_map.h"
#include "light/sampling/environment_portals.h"
#include "unit/light/light_queries.h"

namespace etendue::sky_test {
namespace {

using test::RandomNumbers;

double y_of(const Rgb& color) { return static_cast<double>(luminance(color)); }

Sky sky_at(float degrees, float turbidity = 3) {
  Sky sky;
  sky.sun_elevation = degrees * kPi / 180;
  sky.turbidity = turbidity;
  return sky;
}

// At the equinox the sun rises in the east at 6, culminates at 90 degrees minus the latitude in the south, and sets in the
// west; at the solstice it is at the zenith of the tropic; at a pole its elevation is the declination.
TEST(SunAngles, FollowFromPlaceAndTime) {
  constexpr int kEquinox = 81, kSolstice = 172;
  const auto at = [](float latitude, int day, float hour) {
    Sky sky;
    sky.sun_position = SunPosition::time;
    sky.latitude = latitude * kPi / 180;
    sky.day = day;
    sky.hour = hour;
    return sky;
  };
  const auto expect_direction = [&](const Sky& sky, const Vec3& expected) {
    const Vec3 direction = sun_direction(sky);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(direction[c], expected[c], 1e-6) << sky.hour << " h, axis " << c;
  };
  const float sine = std::sin(50 * kPi / 180), cosine = std::cos(50 * kPi / 180);
  expect_direction(at(50, kEquinox, 6), {1, 0, 0});
  expect_direction(at(50, kEquinox, 12), {0, cosine, sine});
  expect_direction(at(50, kEquinox, 18), {-1, 0, 0});
  expect_direction(at(-50, kEquinox, 12), {0, cosine, -sine});
  EXPECT_NEAR(sun_angles(at(23.45f, kSolstice, 12)).elevation, kPi / 2, 2e-3);
  for (const float hour : {0.0f, 7.0f, 12.0f})
    EXPECT_NEAR(sun_angles(at(90, kSolstice, hour)).elevation, 23.45f * kPi / 180, 1e-3) << hour;
}

// At night there is no sun; in the evening it is weaker than at noon.
TEST(SunAngles, TheSunDoesNotShineAtNight) {
  Sky sky;
  sky.sun_position = SunPosition::time;
  const auto radiance_at = [&](float hour) {
    sky.hour = hour;
    return y_of(sun_radiance(sky));
  };
  EXPECT_EQ(radiance_at(0), 0);
  EXPECT_GT(radiance_at(19), 0);
  EXPECT_LT(radiance_at(19), 0.5 * radiance_at(12));
  sky.hour = 0;
  EXPECT_FALSE(sun_angles(sky).is_up);
  EXPECT_FALSE(make_sky(sky).sun);
}

// Illuminance of the horizontal by the map, without the sun's disk.
double horizontal_illuminance(const Sky& sky) {
  RandomNumbers random(1);
  double sum = 0;
  constexpr int kSamples = 20'000;
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 d = square_to_cosine_hemisphere(random.pair());
    sum += y_of(sky_radiance(sky, {d.x, d.z, d.y}));
  }
  return sum * static_cast<double>(kPi) / kSamples;
}

// The illuminance of the horizontal by directions that the environment samples is that of the sun's disk and of the map,
// also with a tint. The sun is in one direction, so the standard error is that of the sky: below 1 %.
TEST(SkySampling, HasTheIlluminanceOfSunAndSky) {
  for (const float tint : {1.0f, 0.25f}) {
    const Sky sky = sky_at(40);
    Environment environment = make_sky(sky);
    environment.tint = Rgb(tint);
    const EnvironmentMap map(environment);
    RandomNumbers random(2);
    double sum = 0;
    constexpr int kSamples = 50'000;
    for (int i = 0; i < kSamples; ++i) {
      const auto sample = map.sample(random.pair(), false);
      if (sample.direction.y > 0 && sample.pdf_solid_angle > 0)
        sum += y_of(sample.radiance) * static_cast<double>(sample.direction.y / sample.pdf_solid_angle);
    }
    const double sun = y_of(sun_radiance(sky)) * static_cast<double>(solid_angle_of_sun()) * std::sin(40 * M_PI / 180);
    const double expected = static_cast<double>(tint) * (sun + horizontal_illuminance(sky));
    EXPECT_NEAR(sum / kSamples, expected, 0.04 * expected) << tint;
  }
}

// The luminance of the zenith in kcd/m^2 [Preetham et al. 1999, eq. A.1], which the gamut of Rec. 709 contains.
TEST(Sky, ZenithHasItsLuminance) {
  for (const float elevation : {10.0f, 35.0f, 60.0f})
    for (const float turbidity : {2.0f, 3.0f, 6.0f}) {
      const double chi = (4.0 / 9 - double{turbidity} / 120) * (2 * double{elevation} * M_PI / 180);
      const double expected =
          (4.0453 * double{turbidity} - 4.9710) * std::tan(chi) - 0.2155 * double{turbidity} + 2.4192;
      EXPECT_NEAR(y_of(sky_radiance(sky_at(elevation, turbidity), {0, 1, 0})) / 1000, expected, 0.01 * expected);
    }
}

// A clear sky gives about 15 klx without the sun, the model up to twice as much; the sun gives about 100 klx across its
// beam when it is high.
TEST(Sky, IlluminancesAreThoseOfHandbooks) {
  const double sky = horizontal_illuminance(sky_at(60, 2.5f));
  EXPECT_GT(sky, 7'000);
  EXPECT_LT(sky, 30'000);
  const double solid_angle = 2 * M_PI * (1 - std::cos(double{kSunAngularRadius}));
  const double high = y_of(sun_radiance(sky_at(60, 2.5f))) * solid_angle;
  EXPECT_GT(high, 85'000);
  EXPECT_LT(high, 110'000);
  const double low = y_of(sun_radiance(sky_at(2, 2.5f))) * solid_angle;
  EXPECT_LT(low, 15'000);
  EXPECT_GT(low, 500);
}

// A low sun is red, a high one almost white; the zenith is blue.
TEST(Sky, ColoursFollowTheSun) {
  const Rgb low = sun_radiance(sky_at(3)), high = sun_radiance(sky_at(80));
  EXPECT_GT(low.r, 3 * low.b);
  EXPECT_LT(high.r, 1.6f * high.b);
  const Rgb zenith = sky_radiance(sky_at(40), {0, 1, 0});
  EXPECT_GT(zenith.b, 1.3f * zenith.r);
}

// The ground has the radiance albedo E / pi, with E by sky and sun.
TEST(Sky, GroundReflectsTheIlluminance) {
  Sky sky = sky_at(40);
  sky.ground_albedo = 0.5f;
  const EnvironmentMap map(make_sky(sky));
  const double solid_angle = 2 * M_PI * (1 - std::cos(double{kSunAngularRadius}));
  const double sun = y_of(sun_radiance(sky)) * solid_angle * std::sin(double{sky.sun_elevation});
  const double expected = 0.5 / M_PI * (horizontal_illuminance(sky) + sun);
  EXPECT_NEAR(y_of(map.radiance({0, -1, 0})), expected, 0.02 * expected);
}

TEST(Sky, EqualSkiesShareTheirMap) {
  const Environment a = make_sky(sky_at(30)), b = make_sky(sky_at(30));
  EXPECT_EQ(a, b);
  EXPECT_FALSE(a == make_sky(sky_at(31)));
}

// The mean of f over its density equals 4 pi times the mean, with the sun, without it, and for a rotated sky. A
// comparison at 5 standard errors has a false-alarm rate of 6e-7.
TEST(Sky, SamplingEstimatesTheIntegral) {
  for (const bool disk : {true, false})
    for (const float rotation : {0.0f, 2.0f}) {
      Sky sky = sky_at(25);
      sky.sun_disk = disk;
      Environment environment = make_sky(sky);
      environment.rotation = rotation;
      environment.tint = Rgb(1e-4f);
      const EnvironmentMap map(environment);
      RandomNumbers random(9);
      double sum = 0, squares = 0;
      constexpr int kSamples = 40'000;
      for (int i = 0; i < kSamples; ++i) {
        const auto s = map.sample(random.pair());
        // Close to the poles the arc cosine loses digits.
        const bool near_pole = std::abs(s.direction.y) > 0.999f;
        ASSERT_NEAR(s.pdf_solid_angle, map.pdf_solid_angle(s.direction),
                    (near_pole ? 0.1f : 2e-3f) * s.pdf_solid_angle);
        const double value = y_of(map.radiance(s.direction)) / static_cast<double>(s.pdf_solid_angle);
        sum += value;
        squares += value * value;
      }
      const double mean = sum / kSamples, error = std::sqrt((squares / kSamples - mean * mean) / kSamples);
      EXPECT_NEAR(mean, 4 * M_PI * y_of(map.mean_radiance()), 5 * error + 1e-3 * mean);
      EXPECT_LT(error, 5e-3 * mean);
    }
}

// The disk darkens towards its edge by 1 - u (1 - mu), and its mean is the stated radiance.
TEST(SunCone, LimbDarkening) {
  const SunDisk disk{.direction = {0, 1, 0}, .radiance = Rgb(5), .angular_radius = 0.0047f, .limb_darkening = 0.6f};
  const SunCone sun(disk, disk.direction);
  EXPECT_NEAR(sun.radiance({0, 1, 0}).g, 5 / 0.8, 1e-3);
  const auto at = [&](float share) {
    const float angle = share * disk.angular_radius;
    return sun.radiance({std::sin(angle), std::cos(angle), 0}).g;
  };
  EXPECT_NEAR(at(0.99f) / at(0), 1 - 0.6 * (1 - std::sqrt(1 - 0.99 * 0.99)), 2e-2);
  EXPECT_EQ(at(1.02f), 0);
  RandomNumbers random(2);
  double sum = 0;
  constexpr int kSamples = 20'000;
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 d = sun.sample(random.pair());
    ASSERT_GT(sun.pdf(d), 0);
    sum += double{sun.radiance(d).g};
  }
  EXPECT_NEAR(sum / kSamples, 5, 0.05);
  EXPECT_NEAR(1 / (sun.pdf({0, 1, 0}) * sun.solid_angle()), 1, 1e-5);
}

// X, Y and Z divided by 683 lm/W as computed by the authors' own implementation, version 1.4a.
struct HosekValue {
  float elevation, turbidity, albedo;
  double theta, gamma;
  std::array<double, 3> xyz;
};
const HosekValue kHosekValues[] = {
    {0.05, 1, 0, 0, 0.1, {1.32986323, 1.39213494, 1.78168431}},
    {0.05, 1, 1, 1.5, 1, {6.56004377, 7.09499979, 4.63360549}},
    {0.05, 2.3, 0.35, 0.9, 2.4, {2.01240186, 2.21550298, 2.73811999}},
    {0.05, 7.5, 0, 0, 0.1, {3.50978385, 3.34198858, 2.37222379}},
    {0.05, 7.5, 1, 1.5, 1, {4.0201087, 4.12167222, 2.91162635}},
    {0.05, 10, 0.35, 0.9, 2.4, {2.28576482, 2.40680366, 2.30221036}},
    {0.5, 1, 0, 0, 0.1, {3.23091748, 3.29599982, 7.20817072}},
    {0.5, 1, 1, 1.5, 1, {22.9286253, 25.3487347, 34.126354}},
    {0.5, 2.3, 0.35, 0.9, 2.4, {5.60845148, 5.97818176, 11.2817891}},
    {0.5, 7.5, 0, 0, 0.1, {35.5807134, 37.2338669, 33.2043385}},
    {0.5, 7.5, 1, 1.5, 1, {28.7715175, 30.2734878, 30.4057257}},
    {0.5, 10, 0.35, 0.9, 2.4, {5.52523924, 5.72509054, 8.94901782}},
    {1.2, 1, 0, 0, 0.1, {4.34116212, 4.39456711, 9.50297415}},
    {1.2, 1, 1, 1.5, 1, {34.3437394, 37.3519409, 56.8862412}},
    {1.2, 2.3, 0.35, 0.9, 2.4, {6.82062099, 7.13769263, 15.3941669}},
    {1.2, 7.5, 0, 0, 0.1, {51.2579623, 54.8586059, 56.6889792}},
    {1.2, 7.5, 1, 1.5, 1, {45.343054, 48.1643311, 55.7811958}},
    {1.2, 10, 0.35, 0.9, 2.4, {9.4854251, 10.4944751, 14.2367558}},
};

TEST(HosekSky, EqualsTheImplementationOfItsAuthors) {
  for (const HosekValue& v : kHosekValues) {
    Sky sky{.model = SkyModel::hosek_wilkie};
    sky.sun_elevation = v.elevation;
    sky.turbidity = v.turbidity;
    sky.ground_albedo = v.albedo;
    const auto xyz = HosekSky(sky).xyz(std::cos(v.theta), v.gamma);
    for (size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(xyz[c] / 683, v.xyz[c], 2e-6 * v.xyz[c])
          << v.elevation << ' ' << v.turbidity << ' ' << v.albedo << ' ' << c;
  }
}

// The luminance of a map is that of the model. A bright ground brightens the sky, and haze the surroundings of the sun.
TEST(HosekSky, IsAnEnvironment) {
  Sky sky = sky_at(40);
  sky.model = SkyModel::hosek_wilkie;
  const Environment environment = make_sky(sky);
  EXPECT_EQ(environment.file, "hosek-sky");
  EXPECT_EQ(make_environment(*find_builtin_environment("hosek-sky")).sky->model, SkyModel::hosek_wilkie);
  const EnvironmentMap map(environment);
  const Vec3 up = glm::normalize(Vec3(0.2f, 1, -0.3f));
  EXPECT_NEAR(y_of(map.radiance(up)), y_of(sky_radiance(sky, up)), 0.01 * y_of(map.radiance(up)));

  const double illuminance = horizontal_illuminance(sky);
  EXPECT_GT(illuminance, 7'000);
  EXPECT_LT(illuminance, 25'000);
  Sky snow = sky, haze = sky;
  snow.ground_albedo = 0.9f;
  haze.turbidity = 8;
  EXPECT_GT(horizontal_illuminance(snow), 1.05 * illuminance);
  EXPECT_GT(y_of(sky_radiance(haze, sun_direction(haze))), 2 * y_of(sky_radiance(sky, sun_direction(sky))));
  EXPECT_FALSE(make_sky(sky) == make_sky(sky_at(40)));
}

EnvironmentPortals two_portals() {
  return EnvironmentPortals(
      {{.centre = {0, 0, 2}, .half_x = {0.5f, 0, 0}, .half_y = {0, 0.25f, 0}, .normal = {0, 0, -1}},
       {.centre = {2, 0, 0}, .half_x = {0, 0, 0.3f}, .half_y = {0, 0.3f, 0}, .normal = {-1, 0, 0}}});
}

// The density integrates to one over the directions, and is that of the samples: both by a histogram of the octants.
TEST(EnvironmentPortals, SamplesWithTheirDensity) {
  const EnvironmentPortals portals = two_portals();
  const Vec3 from(0.2f, 0.1f, -0.3f);
  RandomNumbers random(4);
  constexpr int kCells = 16, kSamples = 200'000;
  const auto cell = [](const Vec3& d) {
    return std::min(static_cast<size_t>((d.y + 1) * 0.5f * 8), size_t{7}) + (d.z > d.x ? size_t{8} : 0);
  };
  std::array<double, kCells> expected{}, found{};
  for (int i = 0; i < 4 * kSamples; ++i) {
    const Vec3 d = random.direction();
    expected[cell(d)] += 4 * M_PI * static_cast<double>(portals.pdf(from, d)) / (4 * kSamples);
  }
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 d = portals.sample(from, random.pair());
    ASSERT_GT(portals.pdf(from, d), 0);
    found[cell(d)] += 1.0 / kSamples;
  }
  double total = 0;
  for (size_t c = 0; c < kCells; ++c) {
    total += expected[c];
    EXPECT_NEAR(found[c], expected[c], 0.02) << c;
  }
  EXPECT_NEAR(total, 1, 0.02);
}

TEST(EnvironmentPortals, GuideOnlyWhatTheyFace) {
  const EnvironmentPortals portals = two_portals();
  EXPECT_EQ(portals.probability({0, 0, 0}), 0.5f);
  EXPECT_EQ(portals.probability({3, 0, 3}), 0);
  EXPECT_EQ(portals.pdf({3, 0, 3}, {0, 0, 1}), 0);
  EXPECT_EQ(portals.pdf({0, 0, 0}, {0, 0, -1}), 0);
  EXPECT_TRUE(EnvironmentPortals({{.centre = {0, 0, 0}, .half_x = {0, 0, 0}, .half_y = {0, 1, 0}, .normal = {0, 0, 1}}})
                  .empty());
}

}  // namespace
}  // namespace etendue::sky_test
