// The normalised diffusion profile of subsurface scattering.
#include "bsdf/diffusion/normalized_diffusion.h"

#include <gtest/gtest.h>

#include "unit/material/profile_integral.h"

namespace etendue {
namespace {

using test::share_within;

TEST(NormalizedDiffusion, IntegratesToOne) {
  for (const float length : {1e-6f, 1e-3f, 2.0f})
    for (const float albedo : {0.0f, 0.3f, 0.8f, 1.0f}) {
      const NormalizedDiffusion profile(length, albedo);
      EXPECT_NEAR(share_within(profile, static_cast<double>(profile.largest_radius())), 1, 1e-3) << length << albedo;
    }
}

// The share of the light within a sampled radius is the random number.
TEST(NormalizedDiffusion, SampledRadiiFollowTheDistribution) {
  const NormalizedDiffusion profile(0.01f, 0.6f);
  constexpr int kSamples = 4000;
  for (const double radius : {0.002, 0.01, 0.03, 0.1}) {
    int within = 0;
    for (int i = 0; i < kSamples; ++i)
      within += static_cast<double>(profile.sample_radius((static_cast<float>(i) + 0.5f) / kSamples)) < radius ? 1 : 0;
    EXPECT_NEAR(static_cast<double>(within) / kSamples, share_within(profile, radius), 2e-3) << radius;
  }
}

// A higher albedo means more scattering events, and a wider profile at the same mean free path.
TEST(NormalizedDiffusion, WidensWithTheAlbedo) {
  EXPECT_GT(NormalizedDiffusion(1, 0.9f).largest_radius(), NormalizedDiffusion(1, 0.2f).largest_radius());
  EXPECT_NEAR(NormalizedDiffusion(2, 0.5f).largest_radius() / NormalizedDiffusion(1, 0.5f).largest_radius(), 2, 1e-5);
}

}  // namespace
}  // namespace etendue
