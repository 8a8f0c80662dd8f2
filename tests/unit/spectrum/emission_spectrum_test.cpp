// Spectra of emitters: published chromaticities, normalisation, and colours of textures and tints.
#include "spectrum/emission_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "spectrum/observer.h"
#include "spectrum/spectrum_names.h"
#include "spectrum/uplift.h"

namespace etendue {
namespace {

struct PublishedXy {
  double x, y;
};
PublishedXy xy_of_spectrum(const Spectrum& spectrum) {
  const Xyz c = spectrum.xyz();
  const double sum = c.x + c.y + c.z;
  return {c.x / sum, c.y / sum};
}

// [CIE 15:2004, tables T.3, T.5 and T.8]
TEST(EmissionSpectrum, IlluminantsHaveThePublishedChromaticities) {
  const struct {
    const char* name;
    PublishedXy published;
  } cases[] = {
      {"a", {0.44758, 0.40745}}, {"d65", {0.31272, 0.32903}}, {"e", {1 / 3.0, 1 / 3.0}}, {"fl2", {0.3721, 0.3751}}};
  for (const auto& [name, published] : cases) {
    const PublishedXy found = xy_of_spectrum(*find_spectrum(name));
    EXPECT_NEAR(found.x, published.x, 2e-4) << name;
    EXPECT_NEAR(found.y, published.y, 2e-4) << name;
  }
}

// The Planckian locus for c_2 = 1.4388e-2 m K [Wyszecki and Stiles 2000, table 1(3.11)].
TEST(EmissionSpectrum, BlackBodiesLieOnThePlanckianLocus) {
  const struct {
    const char* name;
    PublishedXy published;
  } cases[] = {{"2000K", {0.5267, 0.4133}}, {"4000K", {0.3805, 0.3768}}, {"10000K", {0.2807, 0.2884}}};
  for (const auto& [name, published] : cases) {
    const PublishedXy found = xy_of_spectrum(*find_spectrum(name));
    EXPECT_NEAR(found.x, published.x, 5e-4) << name;
    EXPECT_NEAR(found.y, published.y, 5e-4) << name;
  }
}

// The integral over the wavelengths that paths use, in steps of 1 nm.
std::array<double, 3> integrated(const EmissionSpectrum& spectrum) {
  std::array<double, 3> sum{};
  for (int nm = 380; nm <= 780; ++nm) {
    Wavelengths w;
    w.nm.fill(static_cast<float>(nm));
    const auto value = static_cast<double>(spectrum.at(w)[0]);
    const auto weights = relative_rgb_weights(nm);
    for (size_t c = 0; c < 3; ++c) sum[c] += (nm == 380 || nm == 780 ? 0.5 : 1) * value * weights[c];
  }
  return sum;
}

TEST(EmissionSpectrum, HasALuminanceOfOneAndTheStatedColor) {
  for (const char* name : {"a", "d65", "e", "fl2", "3000K", "20000K"}) {
    const EmissionSpectrumRef ref = *find_emission_spectrum(name);
    const auto rgb = integrated(*ref.spectrum);
    EXPECT_NEAR(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2], 1, 1e-5) << name;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb[static_cast<size_t>(c)], static_cast<double>(ref->rgb()[c]), 1e-5);
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR((*find_emission_spectrum("d65"))->rgb()[c], 1, 1e-3);
}

// A factor without colour keeps the spectrum; a colour is a smooth factor.
TEST(EmissionSpectrum, ScalesWithTheEmittedColor) {
  const EmissionSpectrumRef lamp = *find_emission_spectrum("fl2");
  const Wavelengths w = sample_wavelengths(0.3f);
  const SampledSpectrum once = lamp->at(w), tripled = lamp->emission(3.0f * lamp->rgb(), w);
  const Rgb tint(1, 0.5f, 0.2f);
  const SampledSpectrum tinted = lamp->emission(tint * lamp->rgb(), w), factor = uplift_emission(tint, w);
  for (int i = 0; i < SampledSpectrum::kSize; ++i) {
    EXPECT_NEAR(tripled[i], 3 * once[i], 1e-5f * tripled[i]);
    EXPECT_NEAR(tinted[i], once[i] * factor[i], 1e-4f * once[i]);
  }
}

// Light of one wavelength lies outside the gamut of sRGB: RGB rendering shows its positive components.
TEST(EmissionSpectrum, OfALaserHasNoNegativeColor) {
  const std::string path = ::testing::TempDir() + "laser.csv";
  std::ofstream(path) << "nm,power\n520,0\n521,1\n522,0\n";
  const auto ref = find_emission_spectrum(path);
  ASSERT_TRUE(ref) << ref.error().message;
  EXPECT_EQ((*ref)->rgb().r, 0);
  EXPECT_GT((*ref)->rgb().g, 1);
  const SampledSpectrum emitted = (*ref)->emission((*ref)->rgb(), sample_wavelengths(0.5f));
  EXPECT_TRUE(is_finite(emitted));
}

TEST(EmissionSpectrum, InvalidNamesHaveAnError) {
  EXPECT_FALSE(find_emission_spectrum("d66"));
  EXPECT_FALSE(find_emission_spectrum("-5K"));
  EXPECT_FALSE(find_emission_spectrum("/none.csv"));
  const std::string infrared = ::testing::TempDir() + "infrared.csv";
  std::ofstream(infrared) << "900,1\n1000,1\n";
  const auto black = find_emission_spectrum(infrared);
  ASSERT_FALSE(black);
  EXPECT_NE(black.error().message.find("no visible light"), std::string::npos) << black.error().message;
  EXPECT_FALSE(*find_emission_spectrum("none"));
}

}  // namespace
}  // namespace etendue
