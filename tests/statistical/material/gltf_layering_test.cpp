// White furnace tests of the energy-conserving layering of the glTF surface.
#include <gtest/gtest.h>

#include "support/gltf_cases.h"
#include "support/lobe_checks.h"

namespace etendue::test {
namespace {

Material white(float roughness, float ior, Layering layering) {
  Material m;
  m.metallic = 0;
  m.roughness = roughness;
  m.ior = ior;
  m.layering = layering;
  return m;
}

// 0 stands for a Fresnel term of 1.
constexpr float kIors[] = {1.1f, 1.5f, 2.5f, 0};
constexpr float kRoughnesses[] = {0, 0.05f, 0.15f, 0.3f, 0.6f, 1};
constexpr float kAngles[] = {0, 30, 60, 75, 85, 88, 89.5f};

TEST(EnergyConservingLayering, ReflectsAtMostAllLight) {
  for (const float roughness : kRoughnesses)
    for (const float ior : kIors)
      for (const float theta : kAngles) {
        const auto lobes = lobes_of(white(roughness, ior, Layering::energy_conserving));
        const AlbedoEstimate albedo = sampled_albedo(lobes, direction(theta));
        EXPECT_LE(albedo.value, 1 + 1e-4 + 4 * albedo.error)
            << "roughness " << roughness << ", index " << ior << ", " << theta << " degrees";
      }
}

// The layering of glTF fails the same test, so that the test can fail.
TEST(EnergyConservingLayering, IsNeededAtGrazingAngles) {
  const AlbedoEstimate albedo = sampled_albedo(lobes_of(white(0.3f, 1.5f, Layering::gltf)), direction(85));
  EXPECT_GT(albedo.value, 1.2);
}

// What it loses is the error of the table, and what rough microfacets of a high index scatter more than once.
TEST(EnergyConservingLayering, LosesLittleLight) {
  for (const float roughness : {0.3f, 0.6f, 1.0f})
    for (const float theta : kAngles) {
      const auto lobes = lobes_of(white(roughness, 1.5f, Layering::energy_conserving));
      const AlbedoEstimate albedo = sampled_albedo(lobes, direction(theta));
      EXPECT_GE(albedo.value, 0.99 - 4 * albedo.error) << roughness << ' ' << theta;
    }
}

// Coats, sheen, transmission, diffuse transmission.
TEST(EnergyConservingLayering, HoldsForTheExtensions) {
  for (const GltfCase& c : gltf_cases()) {
    if (c.material.iridescence > 0) continue;
    Material m = c.material;
    m.layering = Layering::energy_conserving;
    m.base_color = m.diffuse_transmission_color = Rgb(1);
    if (!is_black(m.sheen_color)) m.sheen_color = Rgb(1);
    for (const float theta : {1.0f, 45.0f, 75.0f, 88.0f}) {
      const AlbedoEstimate albedo = sampled_albedo(lobes_of(m, c.coat_normal), direction(theta));
      EXPECT_LE(albedo.value, 1 + 1e-4 + 4 * albedo.error) << c.name << ", " << theta << " degrees";
    }
  }
}

// The albedo of anisotropic layers and of thin films is estimated, with the errors that layered_base.h states.
TEST(EnergyConservingLayering, IsApproximateForAnisotropyAndThinFilms) {
  std::vector<std::pair<Material, double>> cases;
  for (const float roughness : {0.1f, 0.3f, 0.6f}) {
    Material brushed = white(roughness, 1.5f, Layering::energy_conserving);
    brushed.anisotropy = 1;
    cases.emplace_back(brushed, 1.04);
    Material filmed = white(roughness, 1.5f, Layering::energy_conserving);
    filmed.iridescence = 1;
    filmed.iridescence_ior = 1.6f;
    cases.emplace_back(filmed, 1.01);
  }
  for (const auto& [material, bound] : cases)
    for (const float theta : {1.0f, 45.0f, 75.0f, 89.0f})
      for (const float azimuth : {0.0f, 1.0f, 1.5708f}) {
        const AlbedoEstimate albedo = sampled_albedo(lobes_of(material), direction(theta, azimuth));
        EXPECT_LE(albedo.value, bound + 4 * albedo.error) << material.roughness << ", " << theta << " degrees";
      }
}

// Metals have no base, and a base without a layer is Lambert's model in both cases.
TEST(EnergyConservingLayering, ChangesOnlySurfacesWithALayerOverABase) {
  Material metal, matt;
  matt.metallic = 0;
  matt.specular = 0;
  for (Material m : {metal, matt}) {
    const auto gltf = lobes_of(m);
    m.layering = Layering::energy_conserving;
    const auto conserving = lobes_of(m);
    const Vec3 o = direction(70), i = direction(40, 2);
    EXPECT_EQ(gltf.eval(o, i, TransportMode::radiance), conserving.eval(o, i, TransportMode::radiance));
  }
}

}  // namespace
}  // namespace etendue::test
