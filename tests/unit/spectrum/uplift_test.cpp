// Spectra for RGB colours, and the sampling of wavelengths.
#include "spectrum/uplift.h"

#include <gtest/gtest.h>

#include <random>

#include "spectrum/observer.h"

namespace etendue {
namespace {

// The largest error of the components of a colour after conversion to a spectrum and back.
double round_trip_error(const Rgb& color) {
  const SigmoidSpectrum spectrum = SigmoidSpectrum::of(color);
  const auto rgb = relative_rgb_of([&](double wavelength) { return spectrum(static_cast<float>(wavelength)); });
  double error = 0;
  for (int c = 0; c < 3; ++c) error = std::max(error, std::abs(rgb[static_cast<size_t>(c)] - double{color[c]}));
  return error;
}

TEST(Uplift, ReproducesColors) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0, 1);
  constexpr int kColors = 20'000;
  double sum = 0, largest = 0;
  for (int i = 0; i < kColors; ++i) {
    const double error = round_trip_error({unit(random), unit(random), unit(random)});
    sum += error;
    largest = std::max(largest, error);
  }
  EXPECT_LT(sum / kColors, 0.001);
  EXPECT_LT(largest, 0.015);
  for (const Rgb& primary :
       {Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1), Rgb(1, 1, 0), Rgb(0, 1, 1), Rgb(1, 0, 1), Rgb(0), Rgb(1)})
    EXPECT_LT(round_trip_error(primary), 0.001);
}

TEST(Uplift, ReflectancesLieBetweenZeroAndOne) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> wide(-0.5f, 1.5f), unit(0, 1);
  for (int i = 0; i < 20'000; ++i) {
    const Wavelengths wavelengths = sample_wavelengths(unit(random));
    const Rgb color(wide(random), wide(random), wide(random));
    for (const float value : uplift_reflectance(color, wavelengths).values) {
      EXPECT_GE(value, 0);
      EXPECT_LE(value, 1);
    }
    const Rgb bright = Rgb(unit(random), unit(random), unit(random)) * 50.0f;
    EXPECT_LE(max_component(uplift_scaled(bright, wavelengths)), max_component(bright) * 1.000001f);
  }
}

TEST(Uplift, GreyIsConstant) {
  const Wavelengths wavelengths = sample_wavelengths(0.3f);
  for (const float grey : {0.0f, 0.18f, 1.0f}) {
    EXPECT_EQ(uplift_reflectance(Rgb(grey), wavelengths), SampledSpectrum(grey));
    EXPECT_EQ(uplift_emission(Rgb(40 * grey), wavelengths), SampledSpectrum(40 * grey));
    EXPECT_EQ(uplift_scaled(Rgb(40 * grey), wavelengths), SampledSpectrum(40 * grey));
  }
}

// The mean of the estimate over equidistant random numbers is an integral over the wavelengths.
Rgb mean_estimate(const std::function<SampledSpectrum(const Wavelengths&)>& radiance) {
  constexpr int kSamples = 100'000;
  double sum[3]{};
  for (int i = 0; i < kSamples; ++i) {
    const Wavelengths wavelengths = sample_wavelengths((static_cast<float>(i) + 0.5f) / kSamples);
    const Rgb estimate = rgb_estimate(radiance(wavelengths), wavelengths);
    for (int c = 0; c < 3; ++c) sum[c] += double{estimate[c]} / kSamples;
  }
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

TEST(Wavelengths, EstimateIsUnbiased) {
  const Rgb white = mean_estimate([](const Wavelengths&) { return SampledSpectrum(1); });
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1, 1e-4f);
  for (const Rgb& color : {Rgb(0.8f, 0.3f, 0.1f), Rgb(0.05f, 0.4f, 0.6f)}) {
    const Rgb reflectance = mean_estimate([&](const Wavelengths& w) { return uplift_reflectance(color, w); });
    const Rgb emission = mean_estimate([&](const Wavelengths& w) { return uplift_emission(color * 7.0f, w); });
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(reflectance[c], color[c], 0.003f);
      EXPECT_NEAR(emission[c], 7 * color[c], 0.04f);
    }
  }
}

// Without the secondary wavelengths the hero wavelength has four times the weight.
TEST(Wavelengths, HeroAloneIsUnbiased) {
  const Rgb color(0.7f, 0.5f, 0.2f);
  const Rgb mean = mean_estimate([&](const Wavelengths& w) {
    SampledSpectrum hero(0);
    hero[0] = SampledSpectrum::kSize * uplift_reflectance(color, w)[0];
    return hero;
  });
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], color[c], 0.003f);
}

TEST(Wavelengths, DensityIntegratesToOne) {
  double integral = 0;
  constexpr int kSteps = 40'000;
  for (int i = 0; i < kSteps; ++i)
    integral += double{wavelength_pdf(380 + 400 * (static_cast<float>(i) + 0.5f) / kSteps)} * 400 / kSteps;
  EXPECT_NEAR(integral, 1, 1e-3);
  EXPECT_EQ(wavelength_pdf(300), 0);
  EXPECT_EQ(wavelength_pdf(900), 0);
}

TEST(Wavelengths, AreVisibleAndDistinct) {
  for (int i = 0; i <= 1000; ++i) {
    const Wavelengths w = sample_wavelengths(std::min(static_cast<float>(i) / 1000, 0.99999994f));
    for (size_t k = 0; k < w.nm.size(); ++k) {
      EXPECT_GE(w.nm[k], 380);
      EXPECT_LE(w.nm[k], 780);
      for (size_t j = 0; j < k; ++j) EXPECT_NE(w.nm[k], w.nm[j]);
    }
  }
}

}  // namespace
}  // namespace etendue
