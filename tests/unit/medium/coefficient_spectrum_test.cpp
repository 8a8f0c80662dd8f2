// Measured coefficients of media: values, RGB equivalents, files and errors.
#include "medium/coefficient_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "medium/medium.h"
#include "spectrum/observer.h"

namespace etendue {
namespace {

std::string file_with(const char* name, const char* rows) {
  const std::string path = ::testing::TempDir() + name;
  std::ofstream(path) << rows;
  return path;
}

CoefficientSpectrumRef found(Coefficient coefficient, const std::string& name) {
  const auto spectrum = find_coefficient_spectrum(coefficient, name);
  EXPECT_TRUE(spectrum) << name;
  return spectrum ? *spectrum : CoefficientSpectrumRef();
}

// [Bucholtz 1995]: 550 and 700 nm, in 1/km.
TEST(CoefficientSpectrum, OfAirHasPublishedValues) {
  const auto air = found(Coefficient::scattering, "air");
  EXPECT_NEAR(1000 * air.spectrum->at(550.0f), 0.01149, 2e-5);
  EXPECT_NEAR(1000 * air.spectrum->at(700.0f), 0.00431, 2e-5);
  const Rgb& rgb = air.spectrum->rgb_of_scattering();
  EXPECT_GT(rgb.b, rgb.g);
  EXPECT_GT(rgb.g, rgb.r);
}

// The transmittance of one over the largest RGB coefficient has the RGB value of the integral over the wavelengths.
TEST(CoefficientSpectrum, RgbAbsorptionIsThatOfTheTransmittance) {
  const auto water = found(Coefficient::absorption, "pure-water");
  const Rgb& rgb = water.spectrum->rgb_of_absorption();
  EXPECT_GT(rgb.r, 5 * rgb.g);
  const float distance = 1 / max_component(rgb);
  const auto expected = relative_rgb_of(
      [&](double nm) { return std::exp(-double{water.spectrum->at(static_cast<float>(nm))} * double{distance}); });
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(std::exp(-rgb[c] * distance), expected[static_cast<size_t>(c)], 1e-3f) << c;
}

TEST(CoefficientSpectrum, ConstantOnesAreRgbConstants) {
  const std::string path = file_with("constant-coefficient.csv", "500,2.5\n600,2.5\n");
  for (const auto coefficient : {Coefficient::scattering, Coefficient::absorption}) {
    const auto spectrum = found(coefficient, path);
    // Constant beyond the first and the last row, too.
    EXPECT_EQ(spectrum.spectrum->at(400.0f), 2.5f);
    EXPECT_EQ(spectrum.spectrum->at(700.0f), 2.5f);
    const bool scatters = coefficient == Coefficient::scattering;
    const Rgb& rgb = scatters ? spectrum.spectrum->rgb_of_scattering() : spectrum.spectrum->rgb_of_absorption();
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb[c], 2.5f, 2e-3f);
  }
}

TEST(CoefficientSpectrum, OfZeroIsClear) {
  const auto clear = found(Coefficient::absorption, file_with("clear.csv", "400,0\n700,0\n"));
  EXPECT_TRUE(is_black(clear.spectrum->rgb_of_absorption()));
}

TEST(CoefficientSpectrum, InvalidNamesHaveAnError) {
  EXPECT_FALSE(find_coefficient_spectrum(Coefficient::absorption, "air"));
  EXPECT_FALSE(find_coefficient_spectrum(Coefficient::scattering, "pure-water"));
  EXPECT_FALSE(find_coefficient_spectrum(Coefficient::scattering, "/no/such/file.csv"));
  EXPECT_FALSE(find_coefficient_spectrum(Coefficient::scattering, file_with("minus.csv", "400,1\n500,-1\n")));
  EXPECT_FALSE(find_coefficient_spectrum(Coefficient::scattering, file_with("nan.csv", "400,1\n500,nan\n")));
  const auto huge = find_coefficient_spectrum(Coefficient::scattering, file_with("huge.csv", "400,1\n500,1e9\n"));
  ASSERT_FALSE(huge);
  EXPECT_NE(huge.error().message.find("1e6"), std::string::npos) << huge.error().message;
  EXPECT_FALSE(*find_coefficient_spectrum(Coefficient::scattering, "none"));
}

// Clear in the whole spectrum for one coefficient, and the sum with the absorption of a colour for the other.
TEST(MediumSpectra, AddTheAttenuationOfTheSolid) {
  MediumDescription m;
  m.set_spectrum(Coefficient::absorption, found(Coefficient::absorption, "pure-water"));
  EXPECT_EQ(m.absorption, m.absorption_spectrum.spectrum->rgb_of_absorption());
  const Wavelengths w = sample_wavelengths(0.3f);
  const SampledSpectrum alone = m.spectra(Rgb(0)).absorption.at(w), both = m.spectra(Rgb(2)).absorption.at(w);
  for (int i = 0; i < SampledSpectrum::kSize; ++i) {
    EXPECT_NEAR(alone[i], m.absorption_spectrum.spectrum->at(w)[i], 1e-6f);
    EXPECT_NEAR(both[i], alone[i] + 2, 1e-5f);
  }
}

}  // namespace
}  // namespace etendue
