// What every surface must keep: samples follow the density, nothing negative, reciprocity, no energy out of nothing.
#include <gtest/gtest.h>

#include <random>

#include "base/hash.h"
#include "material/gltf_surface.h"
#include "support/chi_square.h"
#include "support/directions.h"

namespace etendue {
namespace {

using test::direction, test::Draw;

struct Case {
  std::string name;
  Material material;
};

std::vector<Case> cases() {
  std::vector<Case> list;
  for (const float roughness : {0.3f, 0.6f, 1.0f})
    for (const float metallic : {0.0f, 0.5f, 1.0f})
      for (const float transmission : {0.0f, 0.6f, 1.0f})
        for (const float thickness : {0.0f, 1.0f}) {
          if (thickness > 0 && transmission == 0) continue;
          Material m;
          m.base_color = {0.8f, 0.6f, 0.4f};
          m.roughness = roughness, m.metallic = metallic, m.transmission = transmission, m.thickness = thickness;
          list.push_back({"roughness " + std::to_string(roughness) + " metallic " + std::to_string(metallic) +
                              " transmission " + std::to_string(transmission) + " thickness " +
                              std::to_string(thickness),
                          m});
        }
  Material stretched;
  stretched.metallic = 1, stretched.roughness = 0.4f, stretched.anisotropy = 0.7f;
  list.push_back({"anisotropic", stretched});
  stretched.anisotropy_rotation = 0.7f;
  list.push_back({"anisotropic, turned", stretched});
  Material matte;
  matte.metallic = 0, matte.specular = 0;
  list.push_back({"Lambert", matte});
  return list;
}

StandardLobes<Rgb> lobes_of(const Material& material) {
  StandardLobes<Rgb> lobes;
  add_lobes(SurfaceMaterial(material, {}), {}, lobes);
  return lobes;
}

bool has_delta(const StandardLobes<Rgb>& lobes, const Vec3& wo) {
  Draw draw(1);
  for (int i = 0; i < 256; ++i) {
    LobeSample<Rgb> s;
    if (lobes.sample(wo, {draw.one(), draw.two()}, TransportMode::radiance, s) && s.delta) return true;
  }
  return false;
}

// Chi-square of sampled directions against the integrated density: 1 % false alarms over all cases together.
class EveryMaterial : public testing::TestWithParam<size_t> {};

TEST_P(EveryMaterial, IsSampledByItsDensity) {
  const auto all = cases();
  const auto& c = all[GetParam()];
  const std::vector<Vec3> outs{direction(5), direction(45), direction(80), -direction(30)};
  const double significance = 1 - std::pow(0.99, 1.0 / static_cast<double>(all.size() * outs.size()));
  const auto lobes = lobes_of(c.material);
  auto seed = static_cast<unsigned>(7 + GetParam() * outs.size());
  for (const Vec3& wo : outs) {
    ++seed;
    if (has_delta(lobes, wo)) continue;
    Draw draw(seed);
    const auto result = test::chi_square_on_sphere(
        [&](Vec3& wi) {
          LobeSample<Rgb> s;
          const bool ok = lobes.sample(wo, {draw.one(), draw.two()}, TransportMode::radiance, s);
          wi = s.wi;
          return ok;
        },
        [&](const Vec3& wi) { return lobes.pdf(wo, wi, TransportMode::radiance); }, 100'000);
    EXPECT_GT(result.p_value, significance)
        << c.name << " wo.z " << wo.z << " chi2 " << result.statistic << " dof " << result.degrees;
  }
}
INSTANTIATE_TEST_SUITE_P(Bsdf, EveryMaterial, testing::Range<size_t>(0, cases().size()));

// weight = f cos / pdf for what was sampled.
TEST(Bsdf, SampleWeightIsEvalOverPdf) {
  for (const auto& c : cases())
    for (const auto mode : {TransportMode::radiance, TransportMode::importance}) {
      const auto lobes = lobes_of(c.material);
      Draw draw(3);
      for (int i = 0; i < 500; ++i) {
        const Vec3 wo = direction(80 * draw.one(), 6 * draw.one()) * (draw.one() < 0.5f ? 1.0f : -1.0f);
        LobeSample<Rgb> s;
        if (!lobes.sample(wo, {draw.one(), draw.two()}, mode, s) || s.delta) continue;
        const Rgb expected = lobes.eval(wo, s.wi, mode) * (std::abs(s.wi.z) / lobes.pdf(wo, s.wi, mode));
        for (int k = 0; k < 3; ++k) ASSERT_NEAR(s.weight[k], expected[k], 1e-3f * (1 + expected[k])) << c.name;
      }
    }
}

// A delta's coefficient is what `sample` gives it on average, and every delta that is sampled is listed.
TEST(Bsdf, DeltasAreThoseThatAreSampled) {
  Material mirror, glaze, glass, sheet, mix;
  mirror.base_color = {0.9f, 0.7f, 0.4f}, mirror.metallic = 1;
  glaze.base_color = {0.7f, 0.3f, 0.2f}, glaze.metallic = 0;
  glass.metallic = 0, glass.transmission = 1, glass.thickness = 1;
  sheet = glass, sheet.thickness = 0;
  mix = glass, mix.transmission = 0.6f;
  for (Material* m : {&mirror, &glaze, &glass, &sheet, &mix}) m->roughness = 0;
  const std::pair<Material, int> all[] = {{mirror, 1}, {glaze, 1}, {glass, 2}, {sheet, 2}, {mix, 3}};
  for (const auto& [material, count] : all)
    for (const auto mode : {TransportMode::radiance, TransportMode::importance})
      for (const Vec3& wo : {direction(10), direction(35), -direction(30)}) {
        const auto lobes = lobes_of(material);
        DeltaSet<Rgb> deltas;
        lobes.add_deltas(wo, mode, deltas);
        ASSERT_EQ(deltas.count, count);
        constexpr int kSamples = 20'000;
        std::array<double, DeltaSet<Rgb>::kMaxCount> sums{};
        Draw draw(9);
        for (int i = 0; i < kSamples; ++i) {
          LobeSample<Rgb> s;
          if (!lobes.sample(wo, {draw.one(), draw.two()}, mode, s) || !s.delta) continue;
          size_t k = 0;
          while (k < static_cast<size_t>(count) && glm::length(deltas.lobes[k].wi - s.wi) > 1e-5f) ++k;
          ASSERT_LT(k, static_cast<size_t>(count));
          ASSERT_EQ(s.eta, deltas.lobes[k].eta);
          ASSERT_EQ(s.transmitted, deltas.lobes[k].transmitted);
          sums[k] += average(s.weight) / kSamples;
        }
        // Two of the same direction, of two lobes, are told apart by nothing: their sum is compared.
        for (size_t k = 0; k < static_cast<size_t>(count); ++k) {
          double listed = 0, sampled = 0;
          for (size_t l = 0; l < static_cast<size_t>(count); ++l)
            if (glm::length(deltas.lobes[l].wi - deltas.lobes[k].wi) < 1e-5f)
              listed += average(deltas.lobes[l].weight), sampled += sums[l];
          EXPECT_NEAR(sampled, listed, 0.02 * listed + 0.003) << count << ' ' << wo.z << ' ' << k;
        }
      }
  Material matte;
  DeltaSet<Rgb> none;
  lobes_of(matte).add_deltas(direction(30), TransportMode::radiance, none);
  EXPECT_EQ(none.count, 0);
}

// f(wo, wi) = f(wi, wo) where both are on one side; across a boundary f / eta^2 of the side that is looked into.
TEST(Bsdf, ReciprocalUpToTheSquaredIndexLaw) {
  for (const auto& c : cases()) {
    const auto lobes = lobes_of(c.material);
    const float eta2 = c.material.thickness > 0 ? sqr(c.material.ior) : 1;
    Draw draw(5);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 a = direction(89 * draw.one(), 6 * draw.one()), up = direction(89 * draw.one(), 6 * draw.one());
      const Vec3 b = draw.one() < 0.5f ? up : -up;
      const Rgb forth = lobes.eval(a, b, TransportMode::radiance), back = lobes.eval(b, a, TransportMode::radiance);
      // f(wi -> wo) / eta_o^2 = f(wo -> wi) / eta_i^2                                            thesis (4.137), E8
      const float scale = b.z < 0 ? eta2 : 1;
      for (int k = 0; k < 3; ++k) {
        ASSERT_GE(forth[k], 0);
        ASSERT_NEAR(forth[k] * scale, back[k], 1e-3f * std::max(1e-3f, std::max(forth[k] * scale, back[k])))
            << c.name << " " << a.z << ' ' << b.z;
      }
      const Rgb adjoint = lobes.eval(b, a, TransportMode::importance),
                forward = lobes.eval(a, b, TransportMode::radiance);
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(adjoint[k], forward[k], 1e-3f * std::max(1e-3f, forward[k])) << c.name;
    }
  }
}

double albedo(const StandardLobes<Rgb>& lobes, const Vec3& wo, double& error) {
  Draw draw(11);
  double sum = 0, squares = 0;
  constexpr int kN = 20'000;
  for (int i = 0; i < kN; ++i) {
    LobeSample<Rgb> s;
    if (!lobes.sample(wo, {draw.one(), draw.two()}, TransportMode::importance, s)) continue;
    sum += s.weight.g, squares += sqr(double{s.weight.g});
  }
  error = std::sqrt((squares / kN - sqr(sum / kN)) / kN);
  return sum / kN;
}

// The directional albedo of power never exceeds one, but for what the specification says of a diffuse base: it is
// attenuated by 1 - F(wo.h), which at grazing angles is more than the layer above leaves of the light.
TEST(Bsdf, ConservesEnergyWhereTheSpecificationDoes) {
  for (const auto& c : cases()) {
    Material white = c.material;
    white.base_color = Rgb(1);
    const bool has_base = white.metallic < 1 && white.transmission < 1 && white.specular > 0;
    for (const float theta : {0.0f, 45.0f, 75.0f, 88.0f}) {
      double error = 0;
      const double a = albedo(lobes_of(white), direction(theta), error);
      EXPECT_LE(a, (has_base ? 1.55 : 1 + 1e-4) + 4 * error) << c.name << " theta " << theta;
      if (theta == 0) {
        EXPECT_LE(a, 1.001 + 4 * error) << c.name;
      }
    }
  }
}

Material brushed(float strength, float rotation) {
  Material m;
  m.roughness = 0.4f, m.anisotropy = strength, m.anisotropy_rotation = rotation;
  return m;
}

Vec3 quarter_turned(const Vec3& w) { return {-w.y, w.x, w.z}; }

// Counter-clockwise from the tangent, as KHR_materials_anisotropy has it.
TEST(Anisotropy, RotationTurnsTheSurface) {
  const auto plain = lobes_of(brushed(0.8f, 0)), turned = lobes_of(brushed(0.8f, kPi / 2));
  Draw draw(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 a = direction(80 * draw.one(), 6 * draw.one()), b = direction(80 * draw.one(), 6 * draw.one());
    const float expected = plain.eval(a, b, TransportMode::radiance).r;
    ASSERT_NEAR(turned.eval(quarter_turned(a), quarter_turned(b), TransportMode::radiance).r, expected,
                1e-4f * expected);
  }
}

// Red and green are the direction, blue the share of the strength.
TEST(Anisotropy, TextureTurnsAndWeakensTheFactors) {
  auto image = std::make_shared<image::Image>();
  image->width = image->height = 1, image->channels = 3, image->type = image::PixelType::float32;
  image->floats = {0.5f, 1, 0.25f};
  Texture texture;
  texture.image = image;
  Material textured = brushed(0.8f, 0.3f);
  textured.anisotropy_texture.texture = 0;
  StandardLobes<Rgb> lobes;
  add_lobes(SurfaceMaterial(textured, {texture}), {}, lobes);
  const auto expected = lobes_of(brushed(0.2f, 0.3f + kPi / 2));
  const Vec3 a = direction(30, 1), b = direction(50, 4);
  const float f = expected.eval(a, b, TransportMode::radiance).r;
  EXPECT_NEAR(lobes.eval(a, b, TransportMode::radiance).r, f, 1e-4f * f);
}

// A slab of smooth glass at normal incidence, all inter-reflections: T = (1 - R) / (1 + R) = 0.923077 for eta 1.5.
TEST(Dielectric, SlabTransmittance) {
  float cos_t;
  const float r = fresnel_dielectric(1, 1.5f, cos_t);
  EXPECT_NEAR(r, 0.04f, 1e-6f);
  EXPECT_NEAR((1 - r) / (1 + r), 0.923077f, 1e-6f);
}

// Thesis 4.1.3: Brewster's angle, total reflection, the square relation at 45 degrees.
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

// D and G together are all that is not a delta, and what a surface does not scatter by is black.
TEST(Bsdf, PartsOfTheLettersAddUp) {
  Draw draw(3);
  auto all = cases();
  for (Case c : cases()) {
    c.name += " smooth", c.material.roughness = 0;
    all.push_back(c);
  }
  for (const auto& c : all) {
    const auto lobes = lobes_of(c.material);
    EXPECT_FALSE(lobes.has_component(ScatterType::specular));
    for (int i = 0; i < 200; ++i) {
      const Vec3 wo = direction(180 * draw.one(), 6 * draw.one()), wi = direction(180 * draw.one(), 6 * draw.one());
      const Rgb f = lobes.eval(wo, wi, TransportMode::radiance);
      Rgb sum(0);
      for (const ScatterType letter : {ScatterType::diffuse, ScatterType::glossy, ScatterType::specular}) {
        const Rgb part = lobes.eval_component(letter, wo, wi, TransportMode::radiance);
        EXPECT_TRUE(lobes.has_component(letter) || is_black(part)) << c.name;
        for (int k = 0; k < 3; ++k) EXPECT_GE(part[k], 0) << c.name;
        sum += part;
      }
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k], f[k], 1e-5f * f[k]) << c.name;
    }
  }
}

// A sample's letter is one that the surface scatters by.
TEST(Bsdf, SamplesBearLettersOfTheirSurface) {
  Draw draw(5);
  for (const auto& c : cases()) {
    const auto lobes = lobes_of(c.material);
    for (int i = 0; i < 200; ++i) {
      LobeSample<Rgb> s;
      if (!lobes.sample(direction(80 * draw.one()), {draw.one(), draw.two()}, TransportMode::radiance, s)) continue;
      EXPECT_EQ(s.delta, s.type == ScatterType::specular) << c.name;
      EXPECT_TRUE(s.delta || lobes.has_component(s.type)) << c.name;
    }
  }
}

}  // namespace
}  // namespace etendue
