// The emission of black bodies by temperature: RGB values against spectra.
#include "medium/blackbody_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "spectrum/blackbody.h"
#include "spectrum/observer.h"

namespace etendue {
namespace {

// The linear sRGB value of the spectrum at a relative temperature.
Rgb rgb_of_spectrum(const BlackbodyTable& table, float relative) {
  const auto rgb = relative_rgb_of([&](double nm) {
    Wavelengths w;
    w.nm.fill(static_cast<float>(nm));
    return double{table.at(relative, w)[0]};
  });
  return {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
}

TEST(BlackbodyTable, SpectraHaveTheRgbValues) {
  const BlackbodyTable table(6000);
  for (const float relative : {1.0f, 0.7f, 0.4f}) {
    const Rgb rgb = table.at(relative), spectral = rgb_of_spectrum(table, relative);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(spectral[c], rgb[c], 2e-3f * max_component(rgb)) << relative;
  }
}

TEST(BlackbodyTable, LuminanceIsOneAtTheHighestTemperature) {
  for (const float highest : {1200.0f, 3000.0f, 20000.0f}) {
    const BlackbodyTable table(highest);
    EXPECT_NEAR(luminance(table.at(1)), 1, 1e-4f) << highest;
    EXPECT_NEAR(luminance(rgb_of_spectrum(table, 1)), 1, 1e-3f) << highest;
  }
}

// Planck's law between two wavelengths.
TEST(BlackbodyTable, SpectraFollowPlancksLaw) {
  const BlackbodyTable table(5000);
  Wavelengths w;
  w.nm = {450, 550, 600, 650};
  const SampledSpectrum emitted = table.at(0.6f, w);
  for (int i = 1; i < SampledSpectrum::kSize; ++i) {
    const double a = double{w.nm[0]}, b = double{w.nm[static_cast<size_t>(i)]};
    const double expected = blackbody_at(b, 3000) / d65_at(b) / (blackbody_at(a, 3000) / d65_at(a));
    EXPECT_NEAR(emitted[i] / emitted[0], expected, 1e-3 * expected);
  }
}

TEST(BlackbodyTable, IsFiniteOutsideOfItsRange) {
  for (const float highest : {1.0f, 1e6f}) {
    const BlackbodyTable table(highest);
    for (const float relative : {0.0f, 1e-6f, 1.0f, 2.0f}) {
      EXPECT_TRUE(is_finite(table.at(relative)));
      EXPECT_TRUE(is_finite(table.at(relative, sample_wavelengths(0.9f))));
    }
  }
}

}  // namespace
}  // namespace etendue
