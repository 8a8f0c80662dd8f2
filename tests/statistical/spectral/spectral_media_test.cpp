// Scattering media in spectral rendering: agreement with RGB without colour, Beer's law by wavelength, conservation of
// energy, and agreement of each wavelength with a rendering of a grey medium with the coefficients at that wavelength.
//
// Comparisons of images use expect_agreement, which states its false-alarm rate. Other means are compared within 4.5
// standard errors: one false alarm in 150,000 comparisons.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "render/measured_spectrum.h"
#include "scene/compiled_scene.h"
#include "spectrum/blackbody.h"
#include "spectrum/observer.h"
#include "spectrum/uplift.h"
#include "statistical/media/expected_radiance.h"
#include "support/independent_estimates.h"
#include "support/integrator_scenes.h"
#include "support/scattering_scenes.h"
#include "support/translation.h"

namespace etendue {
namespace {

using render::Document;
using test::expect_radiance;
using test::medium;
using test::medium_boundary;
using test::with;
using test::with_integrator;

constexpr const char* kSpectralIntegrators[] = {"path", "path-pure"};

Document in_spectra(const Document& d) { return with(d, "render.color", "spectral"); }

Document small_view(scene::Scene scene, const Vec3& eye, const Vec3& target, float fov = 1e-4f) {
  return test::document(std::move(scene), look_at(eye, target, {0, 1, 0}, fov), 16, 16);
}

void make_grey(Document& d) {
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  const auto grey = [](Rgb& c) { c = Rgb(luminance(c)); };
  for (Material& m : scene->materials) {
    for (Rgb* c : {&m.base_color, &m.emission, &m.attenuation_color, &m.medium.scattering, &m.medium.absorption})
      grey(*c);
    m.medium.emission = Rgb(luminance(m.medium.emission));
  }
  for (Light& light : scene->lights) grey(light.color);
  grey(scene->environment.tint);
  d.scene = std::move(scene);
}

TEST(SpectralMedia, EqualRgbWithoutColor) {
  Document places[] = {test::foggy_cornell_box(), test::stone_in_murky_water(), test::spot_light_in_fog()};
  for (Document& d : places) {
    make_grey(d);
    for (const char* integrator : kSpectralIntegrators) {
      if (integrator == kSpectralIntegrators[1] && &d == &places[2]) continue;  // it does not find a spot light
      const Document place = with_integrator(d, integrator);
      test::expect_same_mean(place, 32, in_spectra(place), 48, integrator, 5);
    }
  }
}

// ---- Beer's law.

// The linear sRGB value of a spectrum relative to D65, by quadrature with steps of half a nanometre: measured spectra
// have steep edges.
Rgb rgb_of_wavelengths(const std::function<double(float)>& spectrum) {
  constexpr int kSteps = 800;
  Rgb sum(0);
  for (int i = 0; i < kSteps; ++i) {
    const double nm = 380 + 400 * (i + 0.5) / kSteps;
    const auto weights = relative_rgb_weights(nm);
    const double value = spectrum(static_cast<float>(nm)) * 400 / kSteps;
    for (int c = 0; c < 3; ++c) sum[c] += static_cast<float>(value * weights[static_cast<size_t>(c)]);
  }
  return sum;
}

SampledSpectrum at_one_wavelength(const AbsorptionSpectrum& spectrum, float nm) {
  Wavelengths w;
  w.nm.fill(nm);
  return spectrum.at(w);
}

// White light behind a box without a surface. At the thickness at which the densest colour has an optical depth of 1,
// the colour is that of RGB rendering; at others it is the integral of Beer's law over the wavelengths.
TEST(SpectralMedia, AbsorbByBeersLawAtEachWavelength) {
  const Rgb absorption(0.5f, 0.8f, 1.25f);
  const AbsorptionSpectrum spectrum(absorption);
  for (const float depth : {0.5f, 1.0f, 3.0f}) {
    scene::Scene scene;
    const float thickness = depth / absorption.b;
    add(scene, scene::box(Vec3(0.5f * thickness)), medium_boundary(medium(Rgb(0), absorption)));
    scene.environment.tint = Rgb(1);
    const Document d = small_view(std::move(scene), {0.01f, 0.02f, 5}, {0.01f, 0.02f, 0});
    const Rgb expected = rgb_of_wavelengths(
        [&](float nm) { return std::exp(-static_cast<double>(at_one_wavelength(spectrum, nm)[0] * thickness)); });
    for (const char* integrator : kSpectralIntegrators)
      expect_radiance(with_integrator(in_spectra(d), integrator), 1024, expected, 0.01, integrator);
    for (int c = 0; depth == 1 && c < 3; ++c) EXPECT_NEAR(expected[c], std::exp(-absorption[c] * thickness), 0.003f);
  }
}

// White light behind two metres of water with its measured absorption, as an atmosphere.
TEST(SpectralMedia, AbsorbByMeasuredCoefficients) {
  const auto water = find_coefficient_spectrum(Coefficient::absorption, "pure-water");
  ASSERT_TRUE(water);
  scene::Scene scene;
  scene.atmosphere.medium.set_spectrum(Coefficient::absorption, *water);
  scene.atmosphere.radius = 20;
  add(scene, test::quad(5), test::diffuse(Rgb(0), Rgb(1)));
  const Document d = small_view(std::move(scene), {0.01f, 2, 0.02f}, {0.01f, 0, 0.02f});
  const Rgb expected = rgb_of_wavelengths([&](float nm) { return std::exp(-2 * double{water->spectrum->at(nm)}); });
  for (const char* integrator : kSpectralIntegrators)
    expect_radiance(with_integrator(d, integrator), 2048, expected, 0.01, integrator);
  const auto compiled = scene::compile(d.scene, d.camera, nullptr);
  const auto decision = transport::model_for(*compiled).decisions.front();
  EXPECT_EQ(decision.value + ": " + decision.reason, "spectral: the atmosphere has a spectrum");
}

// The attenuation colour of a solid with a surface and an index of 1.
TEST(SpectralMedia, AttenuationOfSolidsIsMultiplicative) {
  const Material liquid = test::liquid(1, {0.9f, 0.5f, 0.3f});
  const float scale = -std::log(0.3f);
  const AbsorptionSpectrum spectrum(Rgb(-std::log(0.9f), -std::log(0.5f), scale));
  scene::Scene scene;
  add(scene, scene::box(Vec3(1)), liquid);
  scene.environment.tint = Rgb(1);
  const Document d = small_view(std::move(scene), {0.01f, 0.02f, 5}, {0.01f, 0.02f, 0});
  const Rgb expected = rgb_of_wavelengths(
      [&](float nm) { return std::exp(-2 * static_cast<double>(at_one_wavelength(spectrum, nm)[0])); });
  expect_radiance(in_spectra(d), 1024, expected, 0.01, "two metres");
}

// ---- Conservation of energy.

TEST(SpectralMedia, WithoutAbsorptionAreInvisibleInAFurnace) {
  for (const Material& ball :
       {medium_boundary(medium({3, 1, 0.3f}, Rgb(0), 0.5f)), test::turbid_liquid(1.5f, medium({3, 1, 0.3f}))}) {
    scene::Scene scene;
    add(scene, test::sphere(1, 24, false), ball);
    scene.environment.tint = Rgb(1);
    for (const char* integrator : kSpectralIntegrators)
      expect_radiance(with_integrator(in_spectra(small_view(scene, {0.1f, 0.2f, 3}, {0.1f, 0.2f, 0})), integrator), 512,
                      Rgb(1), 0.02, integrator);
  }
}

// A ball that disperses light ends three of the four wavelengths inside a medium of which the densities depend on the
// wavelength.
TEST(SpectralMedia, ConserveEnergyAroundDispersiveGlass) {
  scene::Scene scene;
  Material glass = test::liquid(1.6f);
  glass.dispersion = 0.8f;
  add(scene, test::sphere(0.3f, 24, false), glass);
  add(scene, test::sphere(1, 24, false), medium_boundary(medium({2, 1, 0.3f})));
  scene.environment.tint = Rgb(1);
  for (const char* integrator : kSpectralIntegrators)
    expect_radiance(with_integrator(small_view(scene, {0.1f, 0.12f, 3}, {0.1f, 0.12f, 0}), integrator), 2048, Rgb(1),
                    0.02, integrator);
}

// An absorbing, emitting and scattering medium in equilibrium with its surroundings.
TEST(SpectralMedia, InEquilibriumWithASkyOfTheirRadiance) {
  const Rgb radiance(1, 0.6f, 0.3f);
  MediumDescription m = medium({0.5f, 1, 0.7f}, {1, 0.5f, 0.2f});
  m.emission = radiance;
  scene::Scene scene;
  add(scene, test::sphere(1, 24, false), medium_boundary(m));
  scene.environment.tint = radiance;
  const Document d = in_spectra(small_view(scene, {0.1f, 0.2f, 3}, {0.1f, 0.2f, 0}));
  // The smooth spectrum of a colour reproduces it up to the error of the table.
  const Rgb expected = rgb_of_wavelengths([&](float nm) {
    Wavelengths w;
    w.nm.fill(nm);
    return static_cast<double>(uplift_emission(radiance, w)[0]);
  });
  for (const char* integrator : kSpectralIntegrators)
    expect_radiance(with_integrator(d, integrator), 1024, expected, 0.02, integrator);
}

// Measured scattering without absorption in a uniform sky.
TEST(SpectralMedia, WithMeasuredScatteringConserveEnergy) {
  const std::string path = ::testing::TempDir() + "scattering.csv";
  std::ofstream(path) << "400,4\n500,1\n600,2\n700,0.1\n";
  MediumDescription m;
  m.set_spectrum(Coefficient::scattering, *find_coefficient_spectrum(Coefficient::scattering, path));
  for (const char* density : {"", "exponential"}) {
    if (*density) m.density.field = make_density(density);
    scene::Scene scene;
    add(scene, test::sphere(1, 24, false), medium_boundary(m));
    scene.environment.tint = Rgb(1);
    for (const char* integrator : kSpectralIntegrators)
      expect_radiance(with_integrator(small_view(scene, {0.1f, 0.2f, 3}, {0.1f, 0.2f, 0}), integrator), 512, Rgb(1),
                      0.02, integrator);
  }
}

// An opaque medium of 4000 K has the radiance of a black body of this temperature, with the luminance of its emission.
TEST(SpectralMedia, EmitAsBlackBodies) {
  MediumDescription m = medium(Rgb(0), Rgb(40));
  m.emission = Rgb(2);
  m.temperature = 4000;
  const Rgb color = blackbody_color(4000);
  for (const char* density : {"", "constant"}) {
    if (*density) m.density.field = make_density(density);
    scene::Scene scene;
    add(scene, scene::box(Vec3(1)), medium_boundary(m));
    const Document d = in_spectra(small_view(std::move(scene), {0.01f, 0.02f, 5}, {0.01f, 0.02f, 0}));
    for (const char* integrator : kSpectralIntegrators)
      expect_radiance(with_integrator(d, integrator), 2048, color * (2 / luminance(color)), 0.02, integrator);
  }
}

// A white floor below gas that emits; nothing else does.
Document floor_below(const MediumDescription& gas) {
  scene::Scene scene;
  add(scene, test::quad(8), test::diffuse(Rgb(0.8f, 0.5f, 0.3f)));
  add(scene, scene::box(Vec3(0.5f)), medium_boundary(gas), test::at({0, 2, 0}));
  return in_spectra(small_view(std::move(scene), {0.5f, 2, 6}, {0, 0, 0}));
}

// Paths that sample directions towards gas have the mean of paths that find it by chance, and a smaller variance.
TEST(SpectralMedia, LightSamplesOfEmittingMedia) {
  MediumDescription gas = medium({0.4f, 0.8f, 0.2f}, {2, 1, 0.5f}, 0.3f);
  gas.emission = {3, 2, 1};
  MediumDescription flame = gas;
  flame.density.field = make_density("flame");
  flame.temperature = 2500;
  for (const MediumDescription& m : {gas, flame}) {
    const Document d = floor_below(m);
    const test::Mean sampled = test::mean_of(test::rendered(with_integrator(d, "path"), 1024)),
                     by_chance = test::mean_of(test::rendered(with_integrator(d, "path-pure"), 4096));
    const double error = std::hypot(sampled.standard_error, by_chance.standard_error);
    EXPECT_NEAR(sampled.value, by_chance.value, 4.5 * error);
    EXPECT_LT(error, 0.03 * sampled.value);
    EXPECT_LT(sampled.standard_error, 2 * by_chance.standard_error) << "with a quarter of the samples";
  }
}

// ---- Chromatic media.

// A medium in a box above a floor, under a sky.
Document medium_above_floor(const MediumDescription& m) {
  scene::Scene scene;
  add(scene, scene::box({1, 0.5f, 1}), medium_boundary(m));
  add(scene, test::quad(20), test::diffuse(Rgb(0.5f)), [] {
    Mat4 below(1);
    below[3] = Vec4(0, -1, 0, 1);
    return below;
  }());
  scene.environment.tint = Rgb(1);
  return small_view(std::move(scene), {0.1f, 0.4f, 4}, {0.1f, 0, 0});
}

// The spectral radiance of an interval equals that of a rendering whose coefficients are grey, with the values in the
// middle of the interval.
TEST(SpectralMedia, ScatterAtEachWavelengthAsAGreyMediumOfItsCoefficients) {
  MediumDescription homogeneous = medium({4, 1.5f, 0.5f}, {0.1f, 0.3f, 1}, 0.4f);
  MediumDescription gradient = homogeneous;
  gradient.density.field = make_density("exponential");
  for (const MediumDescription& m : {homogeneous, gradient}) {
    const MediumSpectra spectra = m.spectra(Rgb(0));
    const Document d = medium_above_floor(m);
    const auto compiled = scene::compile(d.scene, d.camera, nullptr);
    const auto measured = render::measure_spectrum(d, compiled, 512);
    ASSERT_TRUE(measured) << measured.error().message;
    // White of luminance 1 in the same unit.
    scene::Scene white;
    white.environment.tint = Rgb(1);
    add(white, test::quad(1), test::diffuse(Rgb(1)));
    const Document flat = small_view(white, {0.1f, 3, 0.1f}, {0, 0, 0.1f});
    const auto unit = render::measure_spectrum(flat, scene::compile(flat.scene, flat.camera, nullptr), 64);
    ASSERT_TRUE(unit);
    for (const size_t bin : {13U, 28U, 37U, 48U}) {  // 447.5, 522.5, 567.5 and 622.5 nm
      Wavelengths w;
      w.nm.fill(static_cast<float>(render::MeasuredSpectrum::wavelength(bin)));
      MediumDescription grey = m;
      grey.scattering = Rgb(spectra.scattering.at(w)[0]);
      grey.absorption = Rgb(spectra.absorption.at(w)[0]);
      const test::Mean expected = test::mean_of(test::rendered(medium_above_floor(grey), 64));
      const double found = measured->radiance[bin] / unit->radiance[bin];
      const double error = std::hypot(measured->standard_error[bin] / unit->radiance[bin], expected.standard_error);
      EXPECT_NEAR(found, expected.value, 4.5 * error + 0.003 * expected.value) << w.nm[0] << " nm";
      EXPECT_LT(error, 0.03 * expected.value) << w.nm[0] << " nm";
    }
  }
}

TEST(SpectralMedia, GiveTheSameBitsForAnyNumberOfThreads) {
  const Document d = in_spectra(test::stone_in_murky_water());
  const auto one = test::rendered(d, 3, 1);
  EXPECT_TRUE(test::same_bits(one, test::rendered(d, 3, 2)));
  EXPECT_TRUE(test::same_bits(one, test::rendered(d, 3, 7)));
}

}  // namespace
}  // namespace etendue
