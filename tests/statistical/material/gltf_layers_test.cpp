// The layers of the glTF material extensions: samples follow the density, reciprocity, energy conservation.
#include <gtest/gtest.h>

#include "support/chi_square.h"
#include "support/gltf_cases.h"

namespace etendue::test {
namespace {

// The false-alarm rate is 1 % over all cases and directions.
class EveryLayer : public testing::TestWithParam<size_t> {};

TEST_P(EveryLayer, SamplesFollowTheDensity) {
  const auto all = rough_gltf_cases();
  const auto& c = all[GetParam()];
  const auto lobes = lobes_of(c);
  const std::vector<Vec3> outs{direction(10), direction(50), direction(80), -direction(40)};
  const double significance = 1 - std::pow(0.99, 1.0 / static_cast<double>(all.size() * outs.size()));
  auto seed = static_cast<unsigned>(1000 + GetParam() * outs.size());
  for (const Vec3& wo : outs) {
    Random random(++seed);
    const auto result = chi_square_on_sphere(
        [&](Vec3& wi) {
          LobeSample<Rgb> s;
          const bool ok = lobes.sample(wo, random.lobe(), TransportMode::radiance, s);
          wi = s.wi;
          return ok;
        },
        [&](const Vec3& wi) { return lobes.pdf(wo, wi, TransportMode::radiance); }, 50'000);
    EXPECT_GT(result.p_value, significance)
        << c.name << " wo.z " << wo.z << " chi2 " << result.statistic << " dof " << result.degrees;
  }
}
INSTANTIATE_TEST_SUITE_P(Gltf, EveryLayer, testing::Range<size_t>(0, rough_gltf_cases().size()));

TEST(GltfLayers, SampleWeightIsFCosOverPdf) {
  for (const auto& c : gltf_cases())
    for (const auto mode : {TransportMode::radiance, TransportMode::importance}) {
      const auto lobes = lobes_of(c);
      Random random(3);
      for (int i = 0; i < 500; ++i) {
        const Vec3 wo = random.any_direction();
        LobeSample<Rgb> s;
        if (!lobes.sample(wo, random.lobe(), mode, s) || s.delta) continue;
        EXPECT_EQ(s.transmitted, s.wi.z * wo.z < 0) << c.name;
        const Rgb expected = lobes.eval(wo, s.wi, mode) * (std::abs(s.wi.z) / lobes.pdf(wo, s.wi, mode));
        for (int k = 0; k < 3; ++k) ASSERT_NEAR(s.weight[k], expected[k], 1e-3f * (1 + expected[k])) << c.name;
      }
    }
}

// f is reciprocal up to eta^2 for refraction, the adjoint has exchanged arguments, and f is non-negative.
TEST(GltfLayers, AreReciprocal) {
  for (const auto& c : gltf_cases()) {
    const Material& m = c.material;
    const auto lobes = lobes_of(c);
    const float eta2 = m.transmission > 0 && m.thickness > 0 ? sqr(m.ior) : 1;
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 a = direction(89.5f * random.uniform(), 6 * random.uniform()), b = random.any_direction();
      const Rgb forth = lobes.eval(a, b, TransportMode::radiance), back = lobes.eval(b, a, TransportMode::radiance);
      const Rgb adjoint = lobes.eval(b, a, TransportMode::importance);
      const float scale = b.z < 0 ? eta2 : 1;
      for (int k = 0; k < 3; ++k) {
        ASSERT_GE(forth[k], 0) << c.name;
        ASSERT_TRUE(std::isfinite(forth[k])) << c.name;
        ASSERT_NEAR(forth[k] * scale, back[k], 2e-3f * std::max(1e-3f, back[k])) << c.name << ' ' << a.z << ' ' << b.z;
        ASSERT_NEAR(adjoint[k], forth[k], 2e-3f * std::max(1e-3f, forth[k])) << c.name;
      }
    }
  }
}

double albedo(const AllLobes<Rgb>& lobes, const Vec3& wo, double& error) {
  Random random(11);
  double sum = 0, squares = 0;
  constexpr int kN = 20'000;
  for (int i = 0; i < kN; ++i) {
    LobeSample<Rgb> s;
    if (!lobes.sample(wo, random.lobe(), TransportMode::importance, s)) continue;
    const double most = max_component(s.weight);
    sum += most;
    squares += sqr(most);
  }
  error = std::sqrt((squares / kN - sqr(sum / kN)) / kN);
  return sum / kN;
}

// A white surface with a white sheen reflects at most the incident power. For a core material with a diffuse base under
// a layer, the gain of the specification itself at grazing angles (layered.h) is allowed, and nothing in addition.
TEST(GltfLayers, ConserveEnergy) {
  for (const auto& c : gltf_cases()) {
    Material white = c.material;
    white.base_color = white.diffuse_transmission_color = Rgb(1);
    if (!is_black(white.sheen_color)) white.sheen_color = Rgb(1);
    Material bare = white;
    bare.sheen_color = Rgb(0);
    bare.clearcoat = bare.diffuse_transmission = 0;
    for (const float theta : {1.0f, 45.0f, 75.0f, 88.0f, 150.0f}) {
      double error = 0, bare_error = 0;
      const double a = albedo(lobes_of(white, c.coat_normal), direction(theta), error);
      const double below = albedo(lobes_of(bare), direction(theta), bare_error);
      EXPECT_LE(a, std::max(1 + 1e-4, below + 4 * bare_error) + 4 * error) << c.name << " theta " << theta;
      if (white.metallic == 1 || white.transmission == 1) {
        EXPECT_LE(a, 1 + 1e-4 + 4 * error) << c.name << " theta " << theta;
      }
    }
  }
}

// The components of all scattering types sum to f, and only declared types have a component.
TEST(GltfLayers, ComponentsSumToF) {
  Random random(3);
  for (const auto& c : gltf_cases()) {
    const auto lobes = lobes_of(c);
    for (int i = 0; i < 200; ++i) {
      const Vec3 wo = random.any_direction(), wi = random.any_direction();
      const Rgb f = lobes.eval(wo, wi, TransportMode::radiance);
      Rgb sum(0);
      for (const ScatterType letter : {ScatterType::diffuse, ScatterType::glossy, ScatterType::specular}) {
        const Rgb part = lobes.eval_component(letter, wo, wi, TransportMode::radiance);
        EXPECT_TRUE(lobes.has_component(letter) || is_black(part)) << c.name;
        sum += part;
      }
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k], f[k], 1e-5f * f[k]) << c.name;
    }
  }
}

// The mean weight of the samples of a delta is its listed coefficient, and its frequency is the listed probability.
TEST(GltfLayers, ListedDeltasAreTheSampledOnes) {
  constexpr int kSamples = 20'000;
  for (const auto& c : gltf_cases())
    for (const Vec3& wo : {direction(10), direction(55), -direction(25), -direction(60)}) {
      const auto lobes = lobes_of(c);
      DeltaSet<Rgb> deltas;
      lobes.add_deltas(wo, TransportMode::radiance, deltas);
      double listed = 0, sampled = 0, probability = 0, hits = 0;
      for (size_t k = 0; k < static_cast<size_t>(deltas.count); ++k) {
        listed += average(deltas.lobes[k].weight);
        probability += deltas.probabilities[k];
      }
      Random random(9);
      for (int i = 0; i < kSamples; ++i) {
        LobeSample<Rgb> s;
        if (!lobes.sample(wo, random.lobe(), TransportMode::radiance, s) || !s.delta) continue;
        bool known = false;
        for (size_t k = 0; k < static_cast<size_t>(deltas.count); ++k)
          known = known || (glm::length(deltas.lobes[k].wi - s.wi) < 1e-4f && s.eta == deltas.lobes[k].eta);
        ASSERT_TRUE(known) << c.name << ' ' << wo.z;
        sampled += average(s.weight) / kSamples;
        hits += 1.0 / kSamples;
      }
      EXPECT_NEAR(hits, probability, 0.015) << c.name << ' ' << wo.z;
      EXPECT_NEAR(sampled, listed, 0.03 * listed + 0.005) << c.name << ' ' << wo.z;
    }
}

TEST(GltfLayers, ZeroFactorDisablesTheLayer) {
  Material m;
  m.clearcoat_roughness = 0.5f;
  m.sheen_roughness = 0.5f;
  m.iridescence_ior = 2;
  m.thickness = 1;
  m.diffuse_transmission_color = {0, 1, 0};
  EXPECT_TRUE(SurfaceMaterial(m, {}).uses_standard_lobes);
  for (auto change : std::initializer_list<void (*)(Material&)>{
           [](Material& x) { x.clearcoat = 0.1f; }, [](Material& x) { x.sheen_color.g = 0.1f; },
           [](Material& x) { x.iridescence = 0.1f; }, [](Material& x) { x.diffuse_transmission = 0.1f; },
           [](Material& x) { x.specular_glossiness = true; },
           [](Material& x) { x.transmission = 1, x.specular = 0.5f; }}) {
    Material with = m;
    change(with);
    EXPECT_FALSE(SurfaceMaterial(with, {}).uses_standard_lobes);
    with.unlit = true;
    EXPECT_TRUE(SurfaceMaterial(with, {}).uses_standard_lobes);
  }
}

}  // namespace
}  // namespace etendue::test
