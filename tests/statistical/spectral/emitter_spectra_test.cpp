// Emitters with spectra: RGB rendering shows their RGB value, spectral rendering the integral over the wavelengths.
//
// Means are compared within 4.5 standard errors: one false alarm in 150,000 comparisons.
#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>

#include "render/measured_spectrum.h"
#include "scene/compiled_scene.h"
#include "spectrum/observer.h"
#include "spectrum/spectrum_names.h"
#include "spectrum/uplift.h"
#include "statistical/media/expected_radiance.h"
#include "support/integrator_scenes.h"
#include "transport/model.h"

namespace etendue {
namespace {

using render::Document;
using test::expect_radiance;
using test::with;

// A floor of this colour under one emitter, seen from above.
Document lit_floor(scene::Scene scene, const Rgb& albedo) {
  add(scene, test::quad(50), test::diffuse(albedo));
  return test::document(std::move(scene), look_at({0, 1, 0.01f}, {0, 0, 0.01f}, {0, 0, 1}, 1e-3f), 16, 16);
}

Mat4 above_floor() {  // turns -z to -y
  Mat4 m(1);
  m[1] = Vec4(0, 0, -1, 0);
  m[2] = Vec4(0, 1, 0, 0);
  m[3] = Vec4(0, 2, 0, 1);
  return m;
}

struct LitFloor {
  std::string name;
  scene::Scene scene;
};
// A scene for each kind of emitter, with a spectrum and a tint.
std::vector<LitFloor> emitters(const EmissionSpectrumRef& spectrum, const Rgb& tint) {
  std::vector<LitFloor> list;
  for (const char* type : {"point", "spot", "directional", "quad", "sphere"}) {
    Light light = make_light(type, {{"intensity", 5.0}});
    light.color = tint;
    light.spectrum = spectrum;
    scene::Scene scene;
    scene::add(scene, light, {.translation = {0, 2, 0}, .rotation = {-std::sqrt(0.5f), 0, 0, std::sqrt(0.5f)}});
    list.push_back({type, std::move(scene)});
  }
  scene::Scene sky;
  sky.environment.tint = tint;
  sky.environment.spectrum = spectrum;
  list.push_back({"environment", std::move(sky)});
  Material glowing = test::diffuse(Rgb(0), 3.0f * tint);
  glowing.emission_spectrum = spectrum;
  scene::Scene material;
  add(material, test::quad(0.5f), glowing, above_floor());
  list.push_back({"material", std::move(material)});
  return list;
}

// A grey floor shows the same colour in both modes.
TEST(EmitterSpectra, OfAllEmittersHaveTheirRgbValueInBothModes) {
  const EmissionSpectrumRef spectrum = *find_emission_spectrum("a");
  for (auto& [name, scene] : emitters(spectrum, Rgb(1))) {
    const Document d = lit_floor(scene, Rgb(0.5f));
    const Rgb rgb = test::mean_color(test::rendered(with(d, "render.color", "rgb"), 1024));
    for (int c = 0; c < 3; ++c)  // the ratio of the channels is that of the spectrum
      EXPECT_NEAR(rgb[c] / rgb.g, spectrum->rgb()[c] / spectrum->rgb().g, 2e-4f) << name;
    expect_radiance(with(d, "render.color", "spectral"), 1024, rgb, 0.02, name);
  }
}

// A coloured floor under a light source with spectral lines: products of spectra, not of colours.
TEST(EmitterSpectra, ShowTheProductOfSpectra) {
  const EmissionSpectrumRef lamp = *find_emission_spectrum("fl2");
  const Rgb albedo(0.7f, 0.3f, 0.2f), tint(1, 0.8f, 0.5f);
  Rgb expected(0);
  constexpr float kStep = 0.5f;
  for (float nm = 380 + kStep / 2; nm < 780; nm += kStep) {
    Wavelengths w;
    w.nm.fill(nm);
    const float value = lamp->at(w)[0] * uplift_reflectance(albedo, w)[0] * uplift_emission(tint, w)[0];
    const auto weights = relative_rgb_weights(double{nm});
    for (int c = 0; c < 3; ++c) expected[c] += kStep * value * static_cast<float>(weights[static_cast<size_t>(c)]);
  }
  scene::Scene scene;
  scene.environment.tint = tint;
  scene.environment.spectrum = lamp;
  const Document d = lit_floor(std::move(scene), albedo);
  expect_radiance(with(d, "render.color", "spectral"), 4096, expected, 0.005, "fl2");
  const Rgb product = albedo * tint * lamp->rgb();
  EXPECT_GT(std::abs(product.r - expected.r), 0.02f) << "the scene does not separate the two modes";
}

TEST(EmitterSpectra, SelectSpectralRendering) {
  scene::Scene scene;
  Light light = make_light("point", {});
  light.name = "lamp";
  light.spectrum = *find_emission_spectrum("2700K");
  scene::add(scene, light, {.translation = {0, 2, 0}});
  const Document d = lit_floor(std::move(scene), Rgb(0.5f));
  const auto compiled = scene::compile(d.scene, d.camera, nullptr);
  const auto decision = transport::model_for(*compiled).decisions.front();
  EXPECT_EQ(decision.value + ": " + decision.reason, "spectral: light 'lamp' has a spectrum");
}

// The measured spectrum of a white surface is that of the light source, and so is its luminous efficacy.
// The mean of an emission spectrum between two wavelengths: it has means of a nanometre at whole nanometres, and is
// linear between them.
double mean_between(const Spectrum& lamp, int low, int high) {
  const auto node = [&](int nm) {
    constexpr int kSteps = 100;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) sum += lamp(std::clamp(nm - 0.5 + (i + 0.5) / kSteps, 380.0, 780.0)) / kSteps;
    return sum;
  };
  double sum = 0;
  for (int nm = low; nm < high; ++nm) sum += (node(nm) + node(nm + 1)) / 2;
  return sum / (high - low);
}

TEST(MeasuredSpectrum, OfAWhiteSurfaceIsThatOfTheLamp) {
  for (const char* name : {"a", "e", "fl2", "6500K"}) {
    scene::Scene scene;
    scene.environment.tint = Rgb(3);
    scene.environment.spectrum = *find_emission_spectrum(name);
    const Document d = lit_floor(std::move(scene), Rgb(1));
    const auto measured = render::measure_spectrum(d, scene::compile(d.scene, d.camera, nullptr), 256);
    ASSERT_TRUE(measured) << measured.error().message;
    EXPECT_NEAR(measured->luminance(), 3, 0.01) << name;
    const Spectrum lamp = *find_spectrum(name);
    EXPECT_NEAR(measured->luminous_efficacy() / lamp.luminous_efficacy(), 1, 0.01) << name;
    const double scale = 3 / (683 * lamp.xyz().y);
    for (size_t i = 0; i < render::MeasuredSpectrum::kBins; ++i) {
      const double nm = render::MeasuredSpectrum::wavelength(i);
      const double mean = scale * mean_between(lamp, static_cast<int>(nm - 2.5), static_cast<int>(nm + 2.5));
      EXPECT_NEAR(measured->radiance[i], mean, 4.5 * measured->standard_error[i] + 0.002 * mean) << name << nm;
    }
  }
}

}  // namespace
}  // namespace etendue
