// The observer, illuminants and the conversion to linear sRGB against published values.
#include "spectrum/observer.h"

#include <gtest/gtest.h>

#include "spectrum/blackbody.h"

namespace etendue {
namespace {

struct WhitePoint {
  double x, y;
};

WhitePoint white_point_of(const std::function<double(double)>& spectrum) {
  const Xyz c = xyz_of(spectrum);
  return {c.x / (c.x + c.y + c.z), c.y / (c.x + c.y + c.z)};
}

TEST(Observer, EqualEnergyHasEqualComponents) {
  const Xyz white = xyz_of([](double) { return 1.0; });
  // The integrals over all wavelengths are 106.857 [CIE 15:2004]; the tables omit 5e-5 of them.
  EXPECT_NEAR(white.x, 106.857, 0.03);
  EXPECT_NEAR(white.y, 106.857, 0.03);
  EXPECT_NEAR(white.z, 106.857, 0.06);
}

TEST(Observer, IlluminantsHaveThePublishedChromaticities) {
  // Published with five digits, for wavelengths up to 830 nm.
  const WhitePoint d65 = white_point_of(d65_at);
  EXPECT_NEAR(d65.x, 0.31272, 2e-5);
  EXPECT_NEAR(d65.y, 0.32903, 2e-5);
  const WhitePoint e = white_point_of([](double) { return 1.0; });
  EXPECT_NEAR(e.x, 1.0 / 3, 1e-4);
  EXPECT_NEAR(e.y, 1.0 / 3, 1e-4);
  const WhitePoint a = white_point_of([](double wavelength) { return blackbody_at(wavelength, 2855.54); });
  EXPECT_NEAR(a.x, 0.44758, 1e-4);
  EXPECT_NEAR(a.y, 0.40745, 1e-4);
}

TEST(Observer, SensitivityIsLargestAt555Nanometres) {
  EXPECT_DOUBLE_EQ(observer_at(555).y, 1);
  EXPECT_LT(observer_at(550).y, 1);
  EXPECT_LT(observer_at(560).y, 1);
  EXPECT_EQ(observer_at(379).y, 0);
  EXPECT_EQ(observer_at(781).y, 0);
}

TEST(Observer, D65IsWhite) {
  for (const double c : relative_rgb_of([](double) { return 1.0; })) EXPECT_NEAR(c, 1, 1e-12);
  const Xyz white = xyz_of(d65_at);
  for (const double c : rgb_of({white.x / white.y, 1, white.z / white.y})) EXPECT_NEAR(c, 1, 1e-12);
}

// Published for D65 with the chromaticity (0.3127, 0.3290), which differs from that of the table in the fifth digit.
TEST(Observer, MatrixIsThatOfSrgb) {
  const double published[3][3] = {
      {3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}};
  const Xyz columns[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (size_t k = 0; k < 3; ++k)
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(rgb_of(columns[k])[c], published[c][k], 1e-3);
}

}  // namespace
}  // namespace etendue
