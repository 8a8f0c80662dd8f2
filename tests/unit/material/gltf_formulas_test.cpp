// Layers of the glTF extensions against formulas that are independent of their implementation.
#include <gtest/gtest.h>

#include "bsdf/lobes/sheen.h"
#include "support/gltf_cases.h"

namespace etendue::test {
namespace {

// A smooth coat of strength s is a mirror with reflectance 4 % s about its own normal, with the cosine of the surface
// normal, and attenuates the base by its reflectance.
TEST(Clearcoat, IsAMirrorAboutItsNormal) {
  Material m;
  m.metallic = 0;
  m.specular = 0;
  m.base_color = Rgb(1);
  m.clearcoat = 0.5f;
  const Vec3 normal = direction(10, 1);
  const auto lobes = lobes_of(m, normal);
  DeltaSet<Rgb> deltas;
  lobes.add_deltas(normal, TransportMode::radiance, deltas);
  ASSERT_EQ(deltas.count, 1);
  EXPECT_LT(glm::length(deltas.lobes[0].wi - normal), 1e-5f);
  EXPECT_NEAR(deltas.lobes[0].weight.r, 0.02f * normal.z, 1e-4f);
  const Vec3 wi = direction(15, 2);
  EXPECT_NEAR(lobes.eval(normal, wi, TransportMode::radiance).r, kInvPi * 0.98f, 1e-4f);
}

TEST(Clearcoat, AttenuatesByTheGreaterReflectanceOfBothDirections) {
  Material m;
  m.metallic = 0;
  m.specular = 0;
  m.base_color = Rgb(1);
  m.clearcoat = 1;
  const Vec3 steep = direction(20), flat = direction(80);
  const float kept = 0.04f + 0.96f * std::pow(1 - flat.z, 5.0f);
  EXPECT_NEAR(lobes_of(m).eval(steep, flat, TransportMode::radiance).r, kInvPi * (1 - kept), 1e-4f);
}

// The tabulated albedo E against the mean sample weight, and its limits: zero for a view along the fibres of a narrow
// sheen.
TEST(Sheen, TableEqualsItsAlbedo) {
  for (const float roughness : {0.31f, 0.5f, 0.77f, 1.0f})
    for (const float theta : {0.0f, 40.0f, 75.0f, 87.0f}) {
      Sheen<Rgb> sheen;
      sheen.color = Rgb(1);
      sheen.roughness = roughness;
      const Vec3 wo = direction(theta);
      Random random(3);
      double sum = 0, squares = 0;
      constexpr int kN = 100'000;
      for (int i = 0; i < kN; ++i) {
        LobeSample<Rgb> s;
        if (!sheen.sample(wo, random.lobe(), TransportMode::radiance, s)) continue;
        sum += s.weight.r;
        squares += sqr(double{s.weight.r});
      }
      const double mean = sum / kN, error = std::sqrt((squares / kN - mean * mean) / kN);
      EXPECT_NEAR(mean, sheen_albedo(wo.z, roughness), 0.002 + 4 * error) << roughness << ' ' << theta;
    }
  EXPECT_LT(sheen_albedo(1, 0.1f), 1e-6f);
  EXPECT_GT(sheen_albedo(0.01f, 0.1f), 1) << "the fit gains energy here, and the lobe divides by it";
}

// alpha is the squared roughness: D at the horizon is (2 + 1 / alpha) / (2 pi).
TEST(Sheen, DistributionFollowsTheSpecification) {
  const Vec3 o = direction(60, 0), i = direction(60, 0);  // h = o, so sin theta_h = sin 60
  const float alpha = 0.25f, x = 0.5f;
  const auto l = [&](float t) {
    const float s = sqr(1 - alpha);
    const auto mix = [s](float p, float q) { return p + (q - p) * s; };
    return mix(21.5473f, 25.3245f) / (1 + mix(3.82987f, 3.32435f) * std::pow(t, mix(0.19823f, 0.16801f))) +
           mix(-1.97760f, -1.27393f) * t + mix(-4.32054f, -4.85967f);
  };
  const float lambda = std::exp(2 * l(0.5f) - l(1 - x));
  const float d = (2 + 1 / alpha) * std::pow(0.75f, 0.5f / alpha) / (2 * kPi);
  EXPECT_NEAR(sheen_shape(o, i, 0.5f), d / (4 * 0.25f * (1 + 2 * lambda)), 1e-4f);
}

// A film with the index of air has no effect at normal incidence, where Schlick's term of the boundary is zero.
TEST(ThinFilm, IndexOfAirLeavesTheBase) {
  for (const Rgb& f0 : {Rgb(0.04f), Rgb(0.2f, 0.1f, 0.5f)}) {
    const Rgb f = ThinFilm{1, 400}.reflectance(1, f0);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(f[k], f0[k], 1e-4f) << k;
  }
}

// A film without thickness leaves the luminance of the base. The white point of the film is that of equal energy, that
// of the renderer is D65.
TEST(ThinFilm, ZeroThicknessLeavesTheBase) {
  EXPECT_NEAR(luminance(ThinFilm{1.3f, 0}.reflectance(1, Rgb(0.04f))), 0.04f, 4e-4f);
}

// For a large optical path difference the interference vanishes: R12 + T^2 R23 / (1 - R12 R23).
TEST(ThinFilm, LargeThicknessAddsPowers) {
  const float r12 = sqr(0.3f / 2.3f), r23 = sqr(0.2f / 2.8f);
  const Rgb f = ThinFilm{1.3f, 1e6f}.reflectance(1, Rgb(0.04f));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(f[k], r12 + sqr(1 - r12) * r23 / (1 - r12 * r23), 1e-4f);
}

// A quarter-wave film with the square root of the index of the base: an antireflection coating.
TEST(ThinFilm, QuarterWaveExtinguishesGreen) {
  const float n = std::sqrt(1.5f);
  const Rgb f = ThinFilm{n, 550 / (4 * n)}.reflectance(1, Rgb(0.04f));
  EXPECT_LT(f.g, 0.002f);
  EXPECT_LT(max_component(f), 0.02f) << "of 0.04 without the film";
  EXPECT_GT(f.b, f.g) << "the film is further from a quarter of the wavelength of blue";
}

// A fraction of the transmitted light of the layer goes to the other side, with its own colour.
TEST(DiffuseTransmission, SplitsTheLightBetweenTheSides) {
  Material m;
  m.metallic = 0;
  m.specular = 0;
  m.base_color = {0.2f, 0.4f, 0.8f};
  m.diffuse_transmission = 0.25f;
  m.diffuse_transmission_color = {1, 0.5f, 0.1f};
  const auto lobes = lobes_of(m);
  const Rgb front = lobes.eval(direction(20), direction(60), TransportMode::radiance);
  const Rgb back = lobes.eval(direction(20), direction(120), TransportMode::radiance);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(front[k], m.base_color[k] * 0.75f * kInvPi, 1e-5f);
    EXPECT_NEAR(back[k], m.diffuse_transmission_color[k] * 0.25f * kInvPi, 1e-5f);
  }
}

TEST(DiffuseTransmission, TransmitsLightIntoAVolume) {
  Material m;
  m.metallic = 0;
  m.diffuse_transmission = 1;
  m.thickness = 1;
  m.attenuation_distance = 1;
  m.attenuation_color = {0.5f, 1, 1};
  EXPECT_TRUE(m.is_solid());
  EXPECT_TRUE(SurfaceMaterial(m, {}).absorbs_inside);
}

// A metal and a plastic, each in both parameterisations.
TEST(SpecularGlossiness, EqualsAMetalOrADielectric) {
  Material gold, gold_too, plastic, plastic_too;
  gold.specular_glossiness = true;
  gold.base_color = Rgb(0);
  gold.specular_color = {1, 0.77f, 0.34f};
  gold.metallic = 0;
  gold.roughness = 0.3f;
  gold_too.base_color = gold.specular_color;
  gold_too.roughness = 0.3f;
  plastic.specular_glossiness = true;
  plastic.base_color = {0.1f, 0.5f, 0.9f};
  plastic.specular_color = Rgb(0.04f);
  plastic.metallic = 0;
  plastic.roughness = 0.6f;
  plastic_too.base_color = plastic.base_color * 0.96f;
  plastic_too.metallic = 0;
  plastic_too.roughness = 0.6f;
  const Vec3 o = direction(30, 0), i = direction(50, 2.5f);
  for (const auto& [one, other] : {std::pair(gold, gold_too), std::pair(plastic, plastic_too)}) {
    const Rgb a = lobes_of(one).eval(o, i, TransportMode::radiance),
              b = lobes_of(other).eval(o, i, TransportMode::radiance);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-4f * (1 + b[k]));
  }
}

// KHR_materials_volume: strength and colour do not affect total internal reflection, and the colour does not affect
// grazing reflection.
TEST(TintedGlass, TotalReflectionIsUnaffected) {
  Material m;
  m.metallic = 0;
  m.roughness = 0;
  m.transmission = 1;
  m.thickness = 1;
  m.specular = 0.5f;
  m.specular_color = {1, 0.5f, 0};
  const auto lobes = lobes_of(m);
  DeltaSet<Rgb> inside, outside;
  lobes.add_deltas(-direction(60), TransportMode::radiance, inside);
  ASSERT_EQ(inside.count, 1);
  EXPECT_EQ(inside.lobes[0].weight, Rgb(1));
  lobes.add_deltas(direction(0), TransportMode::radiance, outside);
  ASSERT_EQ(outside.count, 2);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(outside.lobes[0].weight[k], 0.02f * m.specular_color[k], 1e-5f);
}

}  // namespace
}  // namespace etendue::test
