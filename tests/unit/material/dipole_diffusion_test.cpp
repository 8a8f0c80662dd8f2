// The dipole diffusion profile against closed forms and against the media that it describes.
#include "bsdf/diffusion/dipole_diffusion.h"

#include <gtest/gtest.h>

#include "bsdf/bsdf_model.h"
#include "material/diffusion_of_medium.h"
#include "medium/medium_presets.h"
#include "unit/material/profile_integral.h"

namespace etendue {
namespace {

using test::share_within;

// The hemispherical reflectance of a dielectric boundary from outside in closed form [Duntley 1942].
double diffuse_fresnel_closed_form(double n) {
  const double n2 = n * n, n4 = n2 * n2, sum = n2 + 1;
  return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
         n2 * (n2 - 1) * (n2 - 1) / (sum * sum * sum) * std::log((n - 1) / (n + 1)) -
         2 * n2 * n * (n2 + 2 * n - 1) / (sum * (n4 - 1)) +
         8 * n4 * (n4 + 1) / (sum * (n4 - 1) * (n4 - 1)) * std::log(n);
}

// R of the paper in double precision, from alpha and the extinction.
double published_profile(double r, double alpha, double extinction, double mismatch) {
  const double sigma = extinction * std::sqrt(3 * (1 - alpha));
  double sum = 0;
  for (const double z : {1 / extinction, (1 + 4 * mismatch / 3) / extinction}) {
    const double d = std::sqrt(r * r + z * z);
    sum += z * (sigma + 1 / d) * std::exp(-sigma * d) / (d * d);
  }
  return alpha / (4 * M_PI) * sum;
}

TEST(DipoleDiffusion, DiffuseFresnelEqualsTheClosedForm) {
  for (const float eta : {1.05f, 1.3f, 1.5f, 2.0f, 3.0f}) {
    const double outside = diffuse_fresnel_closed_form(static_cast<double>(eta));
    EXPECT_NEAR(static_cast<double>(diffuse_fresnel_outside(eta)), outside, 2e-5) << eta;
    EXPECT_NEAR(static_cast<double>(diffuse_fresnel_inside(eta)), 1 - (1 - outside) / sqr(static_cast<double>(eta)),
                2e-5)
        << eta;
  }
  EXPECT_EQ(diffuse_fresnel_outside(1), 0);
  EXPECT_EQ(boundary_mismatch(1), 1);
}

// Jensen et al. use a fit to the internal reflectance, accurate to about 1 %.
TEST(DipoleDiffusion, InternalReflectanceIsCloseToThePublishedFit) {
  for (const float eta : {1.3f, 1.5f}) {
    const float fit = -1.440f / sqr(eta) + 0.710f / eta + 0.668f + 0.0636f * eta;
    EXPECT_NEAR(diffuse_fresnel_inside(eta), fit, 0.01f) << eta;
  }
}

// Equation 15 of the paper is the integral of equation 4.
TEST(DipoleDiffusion, AlbedoIsTheIntegralOfThePublishedProfile) {
  for (const float eta : {1.0f, 1.3f, 1.8f})
    for (const float alpha : {0.2f, 0.9f, 0.999f}) {
      const float mismatch = boundary_mismatch(eta);
      const float albedo = DipoleDiffusion::albedo_of(alpha, 1 - alpha, mismatch);
      EXPECT_NEAR(DipoleDiffusion::reduced_albedo(albedo, mismatch), alpha, 1e-4f) << eta << ' ' << alpha;
      const DipoleDiffusion profile(0.5f, albedo, mismatch);
      for (const float r : {0.0f, 0.1f, 0.5f, 2.0f}) {
        const double expected =
            published_profile(static_cast<double>(r), static_cast<double>(alpha), 2, static_cast<double>(mismatch));
        EXPECT_NEAR(static_cast<double>(albedo * profile.value(r)), expected, 2e-3 * expected) << eta << ' ' << alpha;
      }
    }
}

TEST(DipoleDiffusion, IntegratesToOne) {
  for (const float length : {1e-6f, 1e-3f, 2.0f})
    for (const float albedo : {0.0f, 0.3f, 0.8f, 0.99f, 1.0f})
      for (const float eta : {1.0f, 1.3f, 3.0f}) {
        const DipoleDiffusion profile(length, albedo, boundary_mismatch(eta));
        EXPECT_NEAR(share_within(profile, static_cast<double>(profile.largest_radius())), 1, 1e-3)
            << length << ' ' << albedo << ' ' << eta;
      }
}

// The share of the light within the sampled radii of a stratified sequence is the share of the sequence.
TEST(DipoleDiffusion, SampledRadiiFollowTheDistribution) {
  constexpr int kSamples = 4000;
  for (const float albedo : {0.05f, 0.6f, 1.0f}) {
    const DipoleDiffusion profile(0.01f, albedo, boundary_mismatch(1.4f));
    for (const double radius : {0.002, 0.01, 0.03, 0.1}) {
      int within = 0;
      for (int i = 0; i < kSamples; ++i)
        within +=
            static_cast<double>(profile.sample_radius((static_cast<float>(i) + 0.5f) / kSamples)) < radius ? 1 : 0;
      EXPECT_NEAR(static_cast<double>(within) / kSamples, share_within(profile, radius), 1e-3) << radius;
    }
  }
}

// Without absorption all light leaves; a black body returns none. Albedo and alpha grow together.
TEST(DipoleDiffusion, LimitsOfTheAlbedo) {
  for (const float eta : {1.0f, 1.5f, 3.0f}) {
    const float mismatch = boundary_mismatch(eta);
    EXPECT_EQ(DipoleDiffusion::albedo_of(1, 0, mismatch), 1) << eta;
    EXPECT_EQ(DipoleDiffusion::albedo_of(0, 1, mismatch), 0) << eta;
    EXPECT_NEAR(DipoleDiffusion::reduced_albedo(1, mismatch), 1, 1e-6f) << eta;
    EXPECT_NEAR(DipoleDiffusion::reduced_albedo(0, mismatch), 0, 1e-5f) << eta;
    float last = -1;
    for (int i = 0; i <= 100; ++i) {
      const float alpha = DipoleDiffusion::reduced_albedo(static_cast<float>(i) / 100, mismatch);
      EXPECT_GT(alpha, last) << eta << ' ' << i;
      last = alpha;
    }
  }
}

// The presets of the model and of media with the same name have the same coefficients.
TEST(DipoleDiffusion, PresetsDescribeTheMedia) {
  for (const ModelPreset& preset : find_bsdf_model("dipole")->presets) {
    const MediumPreset* medium = find_medium_preset(preset.name);
    ASSERT_TRUE(medium) << preset.name;
    const Subsurface body = with_preset(make_bsdf_model("dipole"), preset.name)->subsurface();
    const auto eta = static_cast<float>(std::get<double>(preset.values.back().second));
    const DiffusionOfMedium expected = diffusion_of(medium->medium, eta);
    for (int k = 0; k < 3; ++k) {
      const float albedo = static_cast<float>(std::get<double>(preset.values[static_cast<size_t>(2 * k)].second));
      const float extinction = medium->medium.scattering[k] + medium->medium.absorption[k];
      EXPECT_NEAR(albedo, expected.albedo[k], 1e-6f) << preset.name;
      EXPECT_NEAR(body.mean_free_path[k] / expected.mean_free_path[k], 1, 1e-5f) << preset.name;
      EXPECT_NEAR(DipoleDiffusion::reduced_albedo(albedo, body.mismatch) * extinction, medium->medium.scattering[k],
                  1e-4f * extinction)
          << preset.name;
    }
  }
}

// The diffuse reflectances that table 1 of the paper lists beside the coefficients, with two digits.
TEST(DipoleDiffusion, PresetsHaveThePublishedReflectance) {
  const std::pair<const char*, Rgb> kPublished[] = {
      {"marble", {0.83f, 0.79f, 0.75f}},    {"skin-1", {0.44f, 0.22f, 0.13f}},
      {"skin-2", {0.63f, 0.44f, 0.34f}},    {"milk", {0.91f, 0.88f, 0.76f}},
      {"skim-milk", {0.81f, 0.81f, 0.69f}}, {"cream", {0.98f, 0.90f, 0.73f}},
      {"ketchup", {0.16f, 0.01f, 0.0f}},    {"spectralon", {1, 1, 1}}};
  for (const auto& [name, reflectance] : kPublished) {
    const auto model = with_preset(make_bsdf_model("dipole"), name);
    for (int k = 0; k < 3; ++k) {
      const auto values = model->parameters();
      const ParameterInfo* albedo = find_parameter(values, std::string("albedo") + Triple::kParts[k]);
      EXPECT_NEAR(std::get<double>(albedo->default_value), static_cast<double>(reflectance[k]), 0.012) << name;
    }
  }
}

// An anisotropic phase function has the profile of the isotropic medium with the reduced coefficient.
TEST(DipoleDiffusion, FollowsTheReducedScattering) {
  MediumDescription forward, isotropic;
  forward.scattering = Rgb(100);
  forward.phase = {make_phase_function("henyey-greenstein")->with("g", 0.75)};
  isotropic.scattering = Rgb(25);
  forward.absorption = isotropic.absorption = {0.1f, 1, 10};
  const DiffusionOfMedium a = diffusion_of(forward, 1.4f), b = diffusion_of(isotropic, 1.4f);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(a.albedo[k], b.albedo[k], 1e-5f);
    EXPECT_NEAR(a.mean_free_path[k] / b.mean_free_path[k], 1, 1e-5f);
  }
}

}  // namespace
}  // namespace etendue
