// Selection of the lobes of the glTF surface: the weights estimate the directional albedos.
#include <gtest/gtest.h>

#include "bsdf/all_lobe_types.h"
#include "bsdf_analysis/sampling_quality.h"
#include "support/gltf_cases.h"

namespace etendue::test {
namespace {

constexpr float kAngles[] = {0, 45, 75, 85, 88};

// The directional albedo of each scattering type, averaged over the colour components: the mean of
// eval_component cos / pdf over samples, plus the coefficients of deltas.
struct Shares {
  double diffuse = 0, glossy = 0, specular = 0;
  double total() const { return diffuse + glossy + specular; }
};
template <class Lobes>
Shares albedo_by_type(const Lobes& lobes, const Vec3& wo) {
  constexpr int kSamples = 40'000;
  Shares shares;
  Random random(7);
  for (int i = 0; i < kSamples; ++i) {
    LobeSample<Rgb> s;
    if (!lobes.sample(wo, random.lobe(), TransportMode::radiance, s) || s.delta) continue;
    const double scale = static_cast<double>(std::abs(s.wi.z) / s.pdf_solid_angle) / kSamples;
    const auto part = [&](ScatterType type) {
      return scale * static_cast<double>(average(lobes.eval_component(type, wo, s.wi, TransportMode::radiance)));
    };
    shares.diffuse += part(ScatterType::diffuse);
    shares.glossy += part(ScatterType::glossy);
  }
  DeltaSet<Rgb> deltas;
  lobes.add_deltas(wo, TransportMode::radiance, deltas);
  for (int k = 0; k < deltas.count; ++k)
    shares.specular += static_cast<double>(average(deltas.lobes[static_cast<size_t>(k)].weight));
  return shares;
}

MetallicRoughness<Rgb> layered(float roughness, float f0, float base) {
  MetallicRoughness<Rgb> lobe;
  lobe.f0 = Rgb(f0);
  lobe.f90 = Rgb(1);
  lobe.dielectric_f0 = f0;
  lobe.dielectric_f90 = 1;
  lobe.base = Rgb(base);
  lobe.facets = gltf_microfacets(roughness, 0);
  return lobe;
}

// The estimate that neglects the microfacets: Schlick's term at the angle to the normal.
double estimate_without_microfacets(const MetallicRoughness<Rgb>& lobe, const Vec3& wo) {
  const double layer = average(lobe.fresnel(wo.z)), base = average(lobe.base) * (1 - lobe.layer_reflectance(wo.z));
  return layer / (layer + base);
}

TEST(GltfSelection, LayerAndBaseAreEstimatedByTheirAlbedos) {
  double largest = 0, largest_without_microfacets = 0;
  for (const bool conserving : {false, true})
    for (const float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f})
      for (const float f0 : {0.02f, 0.04f, 0.2f, 0.8f})
        for (const float base : {0.05f, 0.5f, 1.0f})
          for (const float theta : kAngles) {
            MetallicRoughness<Rgb> lobe = layered(roughness, f0, base);
            if (conserving) lobe.conserve_energy();
            const Vec3 wo = direction(theta);
            const Shares exact = albedo_by_type(lobe, wo);
            const auto found = lobe.albedos(wo);
            const double share = (exact.glossy + exact.specular) / exact.total();
            const auto estimate = static_cast<double>(found.layer / (found.layer + found.base));
            largest = std::max(largest, std::abs(estimate - share));
            largest_without_microfacets =
                std::max(largest_without_microfacets, std::abs(estimate_without_microfacets(lobe, wo) - share));
            // Never zero where the lobe contributes.
            ASSERT_GT(found.layer, 0);
            ASSERT_TRUE(found.base > 0 || exact.diffuse == 0);
          }
  RecordProperty("largest", std::to_string(largest));
  EXPECT_LT(largest, 0.02);
  EXPECT_GT(largest_without_microfacets, 0.5) << "the test distinguishes a poor estimate";
}

// Layers over a base without a reflection of its own, so that each lobe has a scattering type of its own.
std::vector<GltfCase> two_lobes() {
  Material matt;
  matt.metallic = 0;
  matt.specular = 0;
  matt.base_color = Rgb(0.6f);
  std::vector<GltfCase> cases;
  for (const float roughness : {0.0f, 0.3f, 1.0f}) {
    Material coated = matt, sheen = matt;
    coated.clearcoat = 1;
    coated.clearcoat_roughness = roughness;
    cases.push_back({"coat", coated});
    sheen.sheen_color = Rgb(0.8f);
    sheen.sheen_roughness = roughness;
    cases.push_back({"sheen", sheen});
  }
  return cases;
}

TEST(GltfSelection, LobesBelowALayerAreSelectedByTheLightThatReachesThem) {
  double largest = 0;
  for (const GltfCase& c : two_lobes())
    for (const float theta : kAngles) {
      const AllLobes<Rgb> lobes = lobes_of(c);
      const Vec3 wo = direction(theta);
      const Shares exact = albedo_by_type(lobes, wo);
      const double base = exact.diffuse / exact.total();
      largest = std::max(largest, std::abs(static_cast<double>(lobe_set(lobes).selection_probabilities(wo)[0]) - base));
    }
  RecordProperty("largest", std::to_string(largest));
  EXPECT_LT(largest, 0.04);
}

// Rough metals reflect few samples below the surface.
TEST(GltfSelection, RoughMetalsAreWellSampled) {
  for (const float roughness : {0.2f, 0.5f, 0.8f, 1.0f}) {
    Material metal;
    metal.roughness = roughness;
    for (const auto& q : bsdf_analysis::sampling_curve(lobes_of(metal))) {
      if (q.degrees > 80) continue;
      EXPECT_LT(q.deviation, 0.5) << roughness << ' ' << q.degrees;
      EXPECT_LT(q.absorbed, 0.15) << roughness << ' ' << q.degrees;
    }
  }
}

}  // namespace
}  // namespace etendue::test
