// Boundaries between two media, whose relative index replaces the index against a vacuum.
#include <gtest/gtest.h>

#include "support/gltf_cases.h"

namespace etendue::test {
namespace {

Material boundary(float ior, float roughness = 0) {
  Material m;
  m.metallic = 0;
  m.transmission = 1;
  m.thickness = 1;
  m.ior = ior;
  m.roughness = roughness;
  return m;
}

AllLobes<Rgb> immersed(const Material& m, float outside) {
  AllLobes<Rgb> lobes = lobes_of(m);
  const float inside = m.model ? m.model->index_of_refraction() : m.ior;
  lobes.set_relative_eta(inside / outside, outside);
  return lobes;
}

// All kinds of boundaries of solids: exact, weakened, tinted, and that of a BSDF model.
std::vector<Material> boundaries(float ior, float roughness) {
  Material weak = boundary(ior, roughness), colored = weak, model;
  weak.specular = 0.5f;
  colored.specular_color = {0.9f, 0.5f, 0.2f};
  model.model.model =
      make_bsdf_model("dielectric")->with("eta", double{ior})->with("roughness", sqr(double{roughness}));
  return {boundary(ior, roughness), weak, colored, model};
}

TEST(Immersed, EqualIndicesNeitherReflectNorBend) {
  for (const float roughness : {0.0f, 0.4f})
    for (const Material& m : boundaries(1.33f, roughness))
      for (const Vec3& wo : {direction(0), direction(40), -direction(70), direction(89)}) {
        const auto lobes = immersed(m, 1.33f);
        EXPECT_FALSE(lobes.has_non_delta_lobe());
        Random random(5);
        for (int i = 0; i < 100; ++i) {
          LobeSample<Rgb> s;
          ASSERT_TRUE(lobes.sample(wo, random.lobe(), TransportMode::radiance, s));
          EXPECT_TRUE(s.transmitted && s.delta);
          EXPECT_EQ(s.wi, -wo);
          EXPECT_EQ(s.weight, Rgb(1));
          EXPECT_EQ(s.eta, 1);
        }
      }
}

// Ice in water: Snell's law and Fresnel's equations with the ratio of the indices.
TEST(Immersed, RefractsByTheRatio) {
  constexpr float kWater = 1.33f, kIce = 1.31f;
  const auto lobes = immersed(boundary(kIce), kWater);
  for (const float degrees : {10.0f, 45.0f, 75.0f, 82.0f}) {
    const Vec3 wo = direction(degrees);
    DeltaSet<Rgb> deltas;
    lobes.add_deltas(wo, TransportMode::radiance, deltas);
    const float sine = std::sqrt(1 - sqr(wo.z)) * kWater / kIce;
    float cosine;
    const float f = fresnel_dielectric(wo.z, kIce / kWater, cosine);
    ASSERT_EQ(deltas.count, sine < 1 ? 2 : 1);
    EXPECT_NEAR(deltas.lobes[0].weight.g, f, 1e-6f);
    if (sine >= 1) continue;
    EXPECT_NEAR(std::sqrt(1 - sqr(deltas.lobes[1].wi.z)), sine, 1e-5f);
    EXPECT_NEAR(deltas.lobes[1].weight.g, (1 - f) * sqr(kWater / kIce), 1e-5f);
  }
}

// The boundary equals that of a material with the relative index in a vacuum.
TEST(Immersed, IsTheSurfaceOfTheRatioInAVacuum) {
  for (const float roughness : {0.0f, 0.4f})
    for (size_t kind = 0; kind < 4; ++kind) {
      const auto in_water = immersed(boundaries(1.8f, roughness)[kind], 1.2f);
      const auto alone = lobes_of(boundaries(1.8f / 1.2f, roughness)[kind]);
      const Vec3 wo = direction(35);
      for (const Vec3& wi : {direction(20, 2), -direction(10, 1), -direction(50, 4)})
        for (const TransportMode mode : {TransportMode::radiance, TransportMode::importance}) {
          const Rgb a = in_water.eval(wo, wi, mode), b = alone.eval(wo, wi, mode);
          for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-5f * (1 + b[k]));
          EXPECT_NEAR(in_water.pdf(wo, wi, mode), alone.pdf(wo, wi, mode), 1e-5f);
        }
    }
}

}  // namespace
}  // namespace etendue::test
