// Colours of black bodies against published chromaticities.
#include "spectrum/blackbody.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etendue {
namespace {

struct Chromaticity {
  double x, y;
};

// From the CIE 1960 coordinates, in which isotemperature lines are published.
Chromaticity from_uv(double u, double v) {
  const double divisor = 2 * u - 8 * v + 4;
  return {3 * u / divisor, 2 * v / divisor};
}

double encoded(double c) { return 255 * static_cast<double>(linear_to_srgb(static_cast<float>(c))); }

// The 8-bit sRGB values of a chromaticity, at the largest brightness that sRGB can show [IEC 61966-2-1].
void expect_color(double kelvin, Chromaticity c) {
  const double xyz[3] = {c.x / c.y, 1, (1 - c.x - c.y) / c.y};
  const double matrix[3][3] = {
      {3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}};
  double rgb[3], largest = 0;
  for (int i = 0; i < 3; ++i) {
    rgb[i] = std::max(0.0, matrix[i][0] * xyz[0] + matrix[i][1] * xyz[1] + matrix[i][2] * xyz[2]);
    largest = std::max(largest, rgb[i]);
  }
  const Rgb color = blackbody_color(kelvin);
  EXPECT_FLOAT_EQ(max_component(color), 1);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(encoded(double{color[i]}), encoded(rgb[i] / largest), 1.0) << kelvin << " K, channel " << i;
}

TEST(Blackbody, HasThePublishedColors) {
  expect_color(2855.54, {0.44758, 0.40745});  // CIE illuminant A
  // [Wyszecki and Stiles 2000]
  expect_color(1000, {0.6528, 0.3444});
  expect_color(6500, {0.3135, 0.3237});
  expect_color(10000, {0.2807, 0.2884});
  // The isotemperature lines of [Robertson 1968], at these reciprocal megakelvins.
  struct Line {
    double mired, u, v;
  };
  for (const Line& line : {Line{30, 0.18208, 0.27119},
                           {50, 0.18388, 0.27709},
                           {100, 0.19032, 0.29326},
                           {150, 0.19962, 0.30921},
                           {200, 0.21142, 0.32312},
                           {250, 0.22511, 0.33439},
                           {300, 0.24010, 0.34308}})
    expect_color(1e6 / line.mired, from_uv(line.u, line.v));
}

TEST(Blackbody, NearestTemperatureInvertsTheColor) {
  for (const double kelvin : {1000.0, 1850.0, 2856.0, 5000.0, 6504.0, 12000.0, 40000.0})
    for (const float brightness : {1.0f, 0.01f})
      EXPECT_NEAR(nearest_temperature(blackbody_color(kelvin) * brightness), kelvin, 2e-3 * kelvin);
  // D65 lies beside the locus, at a correlated temperature of 6504 K.
  EXPECT_NEAR(nearest_temperature(Rgb(1)), 6504, 150);
}

}  // namespace
}  // namespace etendue
