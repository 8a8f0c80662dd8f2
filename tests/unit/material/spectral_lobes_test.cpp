// Lobes at the wavelengths of a path: sampling agrees with evaluation, and values lie near those of the RGB lobes.
#include "bsdf/spectral_lobes.h"

#include <gtest/gtest.h>

#include "bsdf/all_lobe_types.h"
#include "bsdf/fresnel/metal_spectra.h"
#include "bsdf/fresnel/spectral_fresnel.h"
#include "bsdf/fresnel/spectral_thin_film.h"
#include "spectrum/observer.h"
#include "support/gltf_cases.h"
#include "support/lobe_checks.h"
#include "support/model_cases.h"

namespace etendue {
namespace {

using test::Random;

struct SpectralCase {
  std::string name;
  AllLobes<Rgb> lobes;
};

std::vector<SpectralCase> spectral_cases() {
  std::vector<SpectralCase> cases;
  for (const auto& c : test::gltf_cases()) cases.push_back({c.name, test::lobes_of(c)});
  for (const auto& info : bsdf_model_infos()) {
    const auto model = make_bsdf_model(info.description.name);
    if (model) cases.push_back({info.description.name, test::lobes_of(*model)});
  }
  return cases;
}

TEST(SpectralLobes, SamplingAgreesWithEvaluation) {
  Random random(7);
  for (const SpectralCase& c : spectral_cases()) {
    for (int i = 0; i < 100; ++i) {
      const Wavelengths wavelengths = sample_wavelengths(random.uniform());
      AllLobes<SampledSpectrum> lobes;
      lobes.assign(c.lobes, wavelengths);
      ASSERT_EQ(lobes.size(), c.lobes.size()) << c.name;
      const Vec3 wo = random.any_direction();
      LobeSample<SampledSpectrum> s;
      if (!lobes.sample(wo, random.lobe(), TransportMode::radiance, s)) continue;
      ASSERT_TRUE(is_finite(s.weight)) << c.name;
      for (const float w : s.weight.values) ASSERT_GE(w, 0) << c.name;
      if (s.delta) continue;
      const float pdf = lobes.pdf(wo, s.wi, TransportMode::radiance);
      ASSERT_NEAR(s.pdf_solid_angle, pdf, 2e-3f * pdf) << c.name;
      const SampledSpectrum f = lobes.eval(wo, s.wi, TransportMode::radiance);
      for (int k = 0; k < SampledSpectrum::kSize; ++k)
        ASSERT_NEAR(s.weight[k], f[k] * std::abs(s.wi.z) / pdf, 5e-3f * s.weight[k] + 1e-6f) << c.name;
    }
  }
}

TEST(SpectralLobes, ComponentsSumToTheWhole) {
  Random random(8);
  for (const SpectralCase& c : spectral_cases()) {
    const Wavelengths wavelengths = sample_wavelengths(random.uniform());
    AllLobes<SampledSpectrum> lobes;
    lobes.assign(c.lobes, wavelengths);
    for (int i = 0; i < 20; ++i) {
      const Vec3 wo = random.any_direction(), wi = random.any_direction();
      const SampledSpectrum f = lobes.eval(wo, wi, TransportMode::radiance);
      SampledSpectrum sum(0);
      for (const ScatterType type : {ScatterType::diffuse, ScatterType::glossy, ScatterType::specular})
        sum += lobes.eval_component(type, wo, wi, TransportMode::radiance);
      // The conversion to spectra is not linear in values that several types share.
      for (int k = 0; k < SampledSpectrum::kSize; ++k) ASSERT_NEAR(sum[k], f[k], 0.15f * f[k] + 1e-5f) << c.name;
    }
  }
}

// The value for white light is that of the RGB lobe, up to the error of the conversion and of the sum of lobes.
TEST(SpectralLobes, WhiteLightShowsTheRgbColor) {
  constexpr int kSamples = 2000;
  Random random(9);
  for (const char* name : {"lambert", "phong", "oren-nayar"}) {
    const AllLobes<Rgb> rgb = test::lobes_of(*make_bsdf_model(name));
    const Vec3 wo = random.upper_direction(), wi = random.upper_direction();
    const Rgb expected = rgb.eval(wo, wi, TransportMode::radiance);
    Rgb mean(0);
    for (int i = 0; i < kSamples; ++i) {
      const Wavelengths wavelengths = sample_wavelengths((static_cast<float>(i) + 0.5f) / kSamples);
      AllLobes<SampledSpectrum> lobes;
      lobes.assign(rgb, wavelengths);
      mean += rgb_estimate(lobes.eval(wo, wi, TransportMode::radiance), wavelengths) / kSamples;
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], expected[c], 0.01f * max_component(expected)) << name;
  }
}

TEST(SpectralLobes, MetalsHaveTheirMeasuredReflectance) {
  for (const MetalSpectrum& metal : metal_spectra()) {
    const auto* constants = std::find_if(kConductors.begin(), kConductors.end(),
                                         [&](const auto& c) { return std::string_view(c.name) == metal.name; });
    FresnelTerm<Rgb> rgb{FresnelKind::conductor, Rgb(constants->eta.x, constants->eta.y, constants->eta.z),
                         Rgb(constants->kappa.x, constants->kappa.y, constants->kappa.z)};
    const Wavelengths wavelengths = sample_wavelengths(0.4f);
    AllLobes<Rgb> mirror;
    lobe_set(mirror).add(Mirror<Rgb>{{}, Rgb(1), rgb});
    AllLobes<SampledSpectrum> lobes;
    lobes.assign(mirror, wavelengths);
    const Vec3 wo = test::direction(50);
    LobeSample<SampledSpectrum> s;
    ASSERT_TRUE(lobes.sample(wo, Random(1).lobe(), TransportMode::radiance, s));
    for (int k = 0; k < SampledSpectrum::kSize; ++k) {
      const float wavelength = wavelengths.nm[static_cast<size_t>(k)];
      EXPECT_FLOAT_EQ(s.weight[k], fresnel_conductor(wo.z, metal.eta(wavelength), metal.kappa(wavelength)));
      EXPECT_LE(s.weight[k], 1);
    }
  }
}

// A film whose reflections interfere destructively at one wavelength: a quarter-wave layer between air and glass with
// an index of the geometric mean reflects nothing at normal incidence.
TEST(SpectralLobes, QuarterWaveFilmReflectsNothing) {
  Wavelengths wavelengths = sample_wavelengths(0.2f);
  SpectralThinFilm film;
  film.ior = std::sqrt(1.5f);
  film.wavelengths = &wavelengths;
  film.thickness = wavelengths.nm[2] / (4 * film.ior);
  const SampledSpectrum reflectance = film.reflectance(1, SampledSpectrum(0.04f));
  EXPECT_NEAR(reflectance[2], 0, 1e-4f);
  // A half-wave layer reflects as the uncoated glass.
  film.thickness *= 2;
  EXPECT_NEAR(film.reflectance(1, SampledSpectrum(0.04f))[2], 0.04f, 1e-4f);
}

}  // namespace
}  // namespace etendue
