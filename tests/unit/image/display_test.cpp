// Display transform: exposure, tone curves and sRGB codes, against their formulas in double precision.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "image/display.h"

namespace etendue::test {
namespace {

using image::display_pixels;
using image::tone_mapped;
using image::ToneCurve;

constexpr ToneCurve kAll[] = {ToneCurve::none, ToneCurve::neutral, ToneCurve::aces, ToneCurve::agx};

uint8_t display_grey(float value, float exposure = 0, ToneCurve curve = ToneCurve::none) {
  const float rgb[] = {value, value, value};
  return display_pixels(rgb, exposure, curve)[1];
}

void expect_near(const Rgb& a, const Rgb& b, float tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << c;
}

TEST(Display, RoundsToTheNearestCode) {
  // Decodes each code, and values just inside of its rounding interval, with the sRGB formula in double precision.
  for (int code = 0; code < 256; ++code)
    for (const double offset : {-0.49, 0.0, 0.49}) {
      const double x = std::clamp((code + offset) / 255, 0.0, 1.0);
      const double linear = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
      EXPECT_EQ(display_grey(static_cast<float>(linear)), code) << offset;
    }
}

TEST(Display, ExposureIsInStops) {
  EXPECT_EQ(display_grey(0.125f, 2), display_grey(0.5f));
  EXPECT_EQ(display_grey(0.5f, -1), display_grey(0.25f));
  EXPECT_EQ(display_grey(0.5f, 1), 255);
}

TEST(Display, LinearCurveClamps) { EXPECT_EQ(tone_mapped(Rgb(-1, 0.3f, 7), ToneCurve::none), Rgb(0, 0.3f, 1)); }

TEST(Display, NeutralPreservesBaseColours) {
  // Below the shoulder, only the Fresnel reflectance of 4 % is subtracted.
  expect_near(tone_mapped(Rgb(0.5f, 0.3f, 0.1f), ToneCurve::neutral), Rgb(0.46f, 0.26f, 0.06f), 1e-6f);
  // In the toe, grey x is mapped to 6.25 x^2.
  expect_near(tone_mapped(Rgb(0.04f), ToneCurve::neutral), Rgb(0.01f), 1e-6f);
}

TEST(Display, NeutralCompressesHighlights) {
  // Grey of 1.04 has the peak 1 after subtraction: 1 - 0.24^2 / (1 + 0.24 - 0.76) = 0.88.
  expect_near(tone_mapped(Rgb(1.04f), ToneCurve::neutral), Rgb(0.88f), 1e-5f);
  // Red of 5 has the peak 5, compressed to p = 1 - 0.0576 / 4.48; the other channels are p (1 - 1 / (0.15 (5 - p) +
  // 1)).
  const float p = 1 - 0.0576f / 4.48f, g = 1 - 1 / (0.15f * (5 - p) + 1);
  expect_near(tone_mapped(Rgb(5, 0, 0), ToneCurve::neutral), Rgb(p, p * g, p * g), 1e-5f);
}

TEST(Display, AcesMapsGreyByTheRationalCurve) {
  // The rows of both matrices sum to one, up to 1e-5.
  for (const double x : {0.01, 0.18, 0.5, 1.0, 4.0}) {
    const double v = x / 0.6;
    const double y = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    expect_near(tone_mapped(Rgb(static_cast<float>(x)), ToneCurve::aces), Rgb(static_cast<float>(std::min(y, 1.0))),
                1e-4f);
  }
}

TEST(Display, AgxMapsMiddleGreyByTheFittedCurve) {
  // Middle grey 0.18 in the logarithmic range of 16.5 stops, through the fitted contrast curve and gamma 2.2.
  const double x = (std::log2(0.18) + 12.47393) / 16.5;
  double fit = 0;
  for (const double k : {15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232}) fit = fit * x + k;
  expect_near(tone_mapped(Rgb(0.18f), ToneCurve::agx), Rgb(static_cast<float>(std::pow(fit, 2.2))), 2e-3f);
}

TEST(Display, CurvesIncreaseFromBlackToWhite) {
  for (const ToneCurve curve : kAll) {
    EXPECT_EQ(display_grey(0, 0, curve), 0);
    EXPECT_GE(display_grey(1e4f, 0, curve), 253);
    uint8_t before = 0;
    for (float x = 1e-4f; x < 1e4f; x *= 1.1f) {
      const uint8_t now = display_grey(x, 0, curve);
      EXPECT_GE(now, before) << x;
      before = now;
    }
  }
}

TEST(Display, CurvesPreserveGrey) {
  for (const ToneCurve curve : kAll)
    for (const float x : {0.02f, 0.18f, 0.9f, 3.0f}) {
      const Rgb c = tone_mapped(Rgb(x), curve);
      EXPECT_NEAR(c.r, c.g, 2e-3f);
      EXPECT_NEAR(c.b, c.g, 2e-3f);
    }
}

TEST(Display, InvalidValuesAreBlackOrWhite) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  for (const ToneCurve curve : kAll) {
    EXPECT_EQ(display_grey(kNan, 0, curve), 0);
    EXPECT_EQ(display_grey(-kInf, 0, curve), 0);
    EXPECT_GE(display_grey(kInf, 0, curve), 253);
    EXPECT_GE(display_grey(std::numeric_limits<float>::max(), 20, curve), 253);
  }
}

TEST(Display, OptionNamesMatchTheEnumerators) {
  const auto& options = Options<ToneCurve>::kOptions;
  EXPECT_STREQ(options[static_cast<size_t>(ToneCurve::none)].name, "none");
  EXPECT_STREQ(options[static_cast<size_t>(ToneCurve::neutral)].name, "neutral");
  EXPECT_STREQ(options[static_cast<size_t>(ToneCurve::aces)].name, "aces");
  EXPECT_STREQ(options[static_cast<size_t>(ToneCurve::agx)].name, "agx");
}

}  // namespace
}  // namespace etendue::test
