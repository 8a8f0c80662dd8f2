// The physical sky, the disk of the sun, and environment portals.
#include "light/environments/sky.h"

#include <gtest/gtest.h>

#include <cmath>

#include "light/sampling/environment_map.h"
#include "light/sampling/environment_portals.h"
#include "unit/light/light_queries.h"

namespace etendue {
namespace {

using test::RandomNumbers;

double y_of(const Rgb& color) { return static_cast<double>(luminance(color)); }

Sky sky_at(float degrees, float turbidity = 3) {
  Sky sky;
  sky.sun_elevation = degrees * kPi / 180;
  sky.turbidity = turbidity;
  return sky;
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
}  // namespace etendue
