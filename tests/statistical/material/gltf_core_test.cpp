// The core material of glTF: sampling, reciprocity, energy, deltas, anisotropy, and Fresnel's equations.
#include <gtest/gtest.h>

#include "material/gltf_surface.h"
#include "support/lobe_checks.h"

namespace etendue {
namespace {

using test::direction;
using test::Random;

struct Case {
  std::string name;
  Material material;
};

Material core_material(float roughness, float metallic, float transmission, float thickness) {
  Material m;
  m.base_color = {0.8f, 0.6f, 0.4f};
  m.roughness = roughness;
  m.metallic = metallic;
  m.transmission = transmission;
  m.thickness = thickness;
  return m;
}

std::vector<Case> rough_cases() {
  std::vector<Case> list;
  for (const float roughness : {0.3f, 0.6f, 1.0f})
    for (const float metallic : {0.0f, 0.5f, 1.0f})
      for (const float transmission : {0.0f, 0.6f, 1.0f})
        for (const float thickness : {0.0f, 1.0f}) {
          if (thickness > 0 && transmission == 0) continue;
          list.push_back({"roughness " + std::to_string(roughness) + " metallic " + std::to_string(metallic) +
                              " transmission " + std::to_string(transmission) + " thickness " +
                              std::to_string(thickness),
                          core_material(roughness, metallic, transmission, thickness)});
        }
  Material anisotropic;
  anisotropic.metallic = 1;
  anisotropic.roughness = 0.4f;
  anisotropic.anisotropy = 0.7f;
  list.push_back({"anisotropic", anisotropic});
  anisotropic.anisotropy_rotation = 0.7f;
  list.push_back({"anisotropic, rotated", anisotropic});
  Material lambertian;
  lambertian.metallic = 0;
  lambertian.specular = 0;
  list.push_back({"Lambert", lambertian});
  return list;
}

StandardLobes<Rgb> lobes_of(const Material& material) {
  StandardLobes<Rgb> lobes;
  add_lobes(SurfaceMaterial(material, {}), {}, lobes);
  return lobes;
}

// Solid boundaries with metallic < 1 and no roughness sample deltas; the chi-square test covers densities only.
bool samples_deltas(const StandardLobes<Rgb>& lobes, const Vec3& wo) {
  Random random(1);
  for (int i = 0; i < 256; ++i) {
    LobeSample<Rgb> s;
    if (lobes.sample(wo, random.lobe(), TransportMode::radiance, s) && s.delta) return true;
  }
  return false;
}

class GltfCoreCase : public testing::TestWithParam<size_t> {};
INSTANTIATE_TEST_SUITE_P(Gltf, GltfCoreCase, testing::Range<size_t>(0, rough_cases().size()));

TEST_P(GltfCoreCase, SamplesFollowTheDensity) {
  const auto all = rough_cases();
  const auto& c = all[GetParam()];
  const std::vector<Vec3> outgoing{direction(5), direction(45), direction(80), -direction(30)};
  const double significance = test::family_significance(all.size() * outgoing.size());
  const auto lobes = lobes_of(c.material);
  auto seed = static_cast<unsigned>(7 + GetParam() * outgoing.size());
  for (const Vec3& wo : outgoing) {
    ++seed;
    if (samples_deltas(lobes, wo)) continue;
    Random random(seed);
    const auto result = test::chi_square_of_samples(lobes, wo, random, 100'000);
    EXPECT_GT(result.p_value, significance) << c.name << " wo.z " << wo.z << ' ' << test::text_of(result);
  }
}

TEST(GltfCore, SampleWeightIsFCosOverPdf) {
  for (const auto& c : rough_cases())
    for (const auto mode : {TransportMode::radiance, TransportMode::importance}) {
      const auto lobes = lobes_of(c.material);
      Random random(3);
      for (int i = 0; i < 500; ++i) {
        const Vec3 wo = random.direction_below(80) * (random.uniform() < 0.5f ? 1.0f : -1.0f);
        LobeSample<Rgb> s;
        if (!lobes.sample(wo, random.lobe(), mode, s) || s.delta) continue;
        const Rgb expected = lobes.eval(wo, s.wi, mode) * (std::abs(s.wi.z) / lobes.pdf(wo, s.wi, mode));
        for (int k = 0; k < 3; ++k) ASSERT_NEAR(s.weight[k], expected[k], 1e-3f * (1 + expected[k])) << c.name;
      }
    }
}

struct DeltaCase {
  Material material;
  int deltas;
};

std::vector<DeltaCase> smooth_cases() {
  Material metal, plastic, glass, thin_glass, partly_glass;
  metal.base_color = {0.9f, 0.7f, 0.4f};
  metal.metallic = 1;
  plastic.base_color = {0.7f, 0.3f, 0.2f};
  plastic.metallic = 0;
  glass.metallic = 0;
  glass.transmission = 1;
  glass.thickness = 1;
  thin_glass = glass;
  thin_glass.thickness = 0;
  partly_glass = glass;
  partly_glass.transmission = 0.6f;
  for (Material* m : {&metal, &plastic, &glass, &thin_glass, &partly_glass}) m->roughness = 0;
  return {{metal, 1}, {plastic, 1}, {glass, 2}, {thin_glass, 2}, {partly_glass, 3}};
}

// Every sampled delta is listed, and the mean weight of its samples is its coefficient.
TEST(GltfCore, ListedDeltasAreTheSampledOnes) {
  constexpr int kSamples = 20'000;
  for (const auto& [material, count] : smooth_cases())
    for (const auto mode : {TransportMode::radiance, TransportMode::importance})
      for (const Vec3& wo : {direction(10), direction(35), -direction(30)}) {
        const auto lobes = lobes_of(material);
        DeltaSet<Rgb> deltas;
        lobes.add_deltas(wo, mode, deltas);
        ASSERT_EQ(deltas.count, count);
        std::array<double, DeltaSet<Rgb>::kMaxCount> mean_weights{};
        Random random(9);
        for (int i = 0; i < kSamples; ++i) {
          LobeSample<Rgb> s;
          if (!lobes.sample(wo, random.lobe(), mode, s) || !s.delta) continue;
          size_t k = 0;
          while (k < static_cast<size_t>(count) && glm::length(deltas.lobes[k].wi - s.wi) > 1e-5f) ++k;
          ASSERT_LT(k, static_cast<size_t>(count));
          ASSERT_EQ(s.eta, deltas.lobes[k].eta);
          ASSERT_EQ(s.transmitted, deltas.lobes[k].transmitted);
          mean_weights[k] += average(s.weight) / kSamples;
        }
        // Deltas of two lobes in the same direction cannot be distinguished: their sum is compared.
        for (size_t k = 0; k < static_cast<size_t>(count); ++k) {
          double listed = 0, sampled = 0;
          for (size_t l = 0; l < static_cast<size_t>(count); ++l)
            if (glm::length(deltas.lobes[l].wi - deltas.lobes[k].wi) < 1e-5f) {
              listed += average(deltas.lobes[l].weight);
              sampled += mean_weights[l];
            }
          EXPECT_NEAR(sampled, listed, 0.02 * listed + 0.003) << count << ' ' << wo.z << ' ' << k;
        }
      }
}

TEST(GltfCore, RoughSurfacesHaveNoDeltas) {
  DeltaSet<Rgb> deltas;
  lobes_of(Material()).add_deltas(direction(30), TransportMode::radiance, deltas);
  EXPECT_EQ(deltas.count, 0);
}

// f(i -> o) / eta_o^2 = f(o -> i) / eta_i^2, which is plain reciprocity on one side [Lang, eq. 4.301]. The adjoint
// has exchanged arguments.
TEST(GltfCore, IsReciprocalUpToTheSquaredIndexLaw) {
  for (const auto& c : rough_cases()) {
    const auto lobes = lobes_of(c.material);
    const float eta2 = c.material.thickness > 0 ? sqr(c.material.ior) : 1;
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 a = random.direction_below(89), upper = random.direction_below(89);
      const Vec3 b = random.uniform() < 0.5f ? upper : -upper;
      const Rgb f_ab = lobes.eval(a, b, TransportMode::radiance), f_ba = lobes.eval(b, a, TransportMode::radiance);
      const Rgb adjoint = lobes.eval(b, a, TransportMode::importance);
      const float scale = b.z < 0 ? eta2 : 1;
      for (int k = 0; k < 3; ++k) {
        ASSERT_GE(f_ab[k], 0);
        ASSERT_NEAR(f_ab[k] * scale, f_ba[k], 1e-3f * std::max(1e-3f, std::max(f_ab[k] * scale, f_ba[k])))
            << c.name << ' ' << a.z << ' ' << b.z;
        ASSERT_NEAR(adjoint[k], f_ab[k], 1e-3f * std::max(1e-3f, f_ab[k])) << c.name;
      }
    }
  }
}

// The specification attenuates a diffuse base by 1 - F(<wo, h>), which at grazing angles is more than the layer above
// transmits. All other materials conserve energy.
TEST(GltfCore, GainsEnergyOnlyOverADiffuseBase) {
  for (const auto& c : rough_cases()) {
    Material white = c.material;
    white.base_color = Rgb(1);
    const bool has_base = white.metallic < 1 && white.transmission < 1 && white.specular > 0;
    for (const float theta : {0.0f, 45.0f, 75.0f, 88.0f}) {
      const test::AlbedoEstimate albedo = test::sampled_albedo(lobes_of(white), direction(theta));
      EXPECT_LE(albedo.value, (has_base ? 1.55 : 1 + 1e-4) + 4 * albedo.error) << c.name << " theta " << theta;
      if (theta == 0) {
        EXPECT_LE(albedo.value, 1.001 + 4 * albedo.error) << c.name;
      }
    }
  }
}

TEST(GltfCore, ComponentsSumToF) {
  Random random(3);
  auto all = rough_cases();
  for (Case c : rough_cases()) {
    c.name += " smooth";
    c.material.roughness = 0;
    all.push_back(c);
  }
  for (const auto& c : all) {
    const auto lobes = lobes_of(c.material);
    EXPECT_FALSE(lobes.has_component(ScatterType::specular));
    for (int i = 0; i < 200; ++i) {
      const Vec3 wo = random.direction_below(180);
      test::expect_components_sum_to_f(lobes, wo, random.direction_below(180), c.name);
    }
  }
}

TEST(GltfCore, SampledTypesAreComponentsOfTheSurface) {
  Random random(5);
  for (const auto& c : rough_cases()) {
    const auto lobes = lobes_of(c.material);
    for (int i = 0; i < 200; ++i) {
      LobeSample<Rgb> s;
      if (!lobes.sample(direction(80 * random.uniform()), random.lobe(), TransportMode::radiance, s)) continue;
      EXPECT_EQ(s.delta, s.type == ScatterType::specular) << c.name;
      EXPECT_TRUE(s.delta || lobes.has_component(s.type)) << c.name;
    }
  }
}

Material brushed(float strength, float rotation) {
  Material m;
  m.roughness = 0.4f;
  m.anisotropy = strength;
  m.anisotropy_rotation = rotation;
  return m;
}

Vec3 rotated_by_90_degrees(const Vec3& w) { return {-w.y, w.x, w.z}; }

// Counter-clockwise from the tangent, as KHR_materials_anisotropy defines it.
TEST(Anisotropy, RotationTurnsTheSurface) {
  const auto unrotated = lobes_of(brushed(0.8f, 0)), rotated = lobes_of(brushed(0.8f, kPi / 2));
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 a = random.direction_below(80), b = random.direction_below(80);
    const float expected = unrotated.eval(a, b, TransportMode::radiance).r;
    ASSERT_NEAR(rotated.eval(rotated_by_90_degrees(a), rotated_by_90_degrees(b), TransportMode::radiance).r, expected,
                1e-4f * expected);
  }
}

// Red and green are the direction, blue scales the strength.
TEST(Anisotropy, TextureRotatesDirectionAndScalesStrength) {
  auto image = std::make_shared<image::Image>();
  image->width = 1;
  image->height = 1;
  image->channels = 3;
  image->type = image::PixelType::float32;
  image->floats = {0.5f, 1, 0.25f};
  Texture texture;
  texture.image = image;
  Material textured = brushed(0.8f, 0.3f);
  textured.anisotropy_texture.texture = 0;
  StandardLobes<Rgb> lobes;
  const std::vector<Texture> textures{texture};
  add_lobes(SurfaceMaterial(textured, textures), {}, lobes);
  const auto expected = lobes_of(brushed(0.2f, 0.3f + kPi / 2));
  const Vec3 a = direction(30, 1), b = direction(50, 4);
  const float f = expected.eval(a, b, TransportMode::radiance).r;
  EXPECT_NEAR(lobes.eval(a, b, TransportMode::radiance).r, f, 1e-4f * f);
}

// A slab of smooth glass at normal incidence with all internal reflections: T = (1 - R) / (1 + R).
TEST(Fresnel, SlabTransmittance) {
  float cos_t;
  const float r = fresnel_dielectric(1, 1.5f, cos_t);
  EXPECT_NEAR(r, 0.04f, 1e-6f);
  EXPECT_NEAR((1 - r) / (1 + r), 0.923077f, 1e-6f);
}

// Brewster's angle, 45 degrees, and the critical angle [Lang, eq. 4.67, 4.68].
TEST(Fresnel, KnownAngles) {
  float cos_t;
  const float brewster = std::atan(1.5f);
  const float c = std::cos(brewster);
  const float perpendicular =
      sqr((c - 1.5f * std::sqrt(1 - (1 - c * c) / 2.25f)) / (c + 1.5f * std::sqrt(1 - (1 - c * c) / 2.25f)));
  EXPECT_NEAR(fresnel_dielectric(c, 1.5f, cos_t), 0.5f * perpendicular, 1e-6f);
  EXPECT_NEAR(fresnel_dielectric(std::sqrt(0.5f), 1.5f, cos_t), 0.5f * (0.008466f + 0.092013f), 1e-5f);
  EXPECT_EQ(fresnel_dielectric(std::cos(0.7298f), 1 / 1.5f, cos_t), 1);
  EXPECT_LT(fresnel_dielectric(std::cos(0.7296f), 1 / 1.5f, cos_t), 1);
}

}  // namespace
}  // namespace etendue
