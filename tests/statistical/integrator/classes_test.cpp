// Rendering by path class. The classes of a partition sum to the full image, for each sample and in expectation. They
// agree with closed forms and between integrators. The expression for all paths gives the full image, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "integrator/integrator.h"
#include "render/session.h"
#include "support/independent_estimates.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::classes_test {
namespace {

using test::expect_agreement;
using test::replicated;
using test::same_bits;

render::Document cornell() {
  auto d = *render::new_document("cornell");
  d.width = d.height = test::kSize;
  return d;
}

// A glazed sphere: a smooth coat over clay, so that one surface has both delta and non-delta lobes.
render::Document glazed() {
  auto d = test::glossy_scene();
  auto scene = *d.scene;
  for (auto& m : scene.materials)
    if (m.metallic == 0 && m.transmission == 0 && m.specular == 1) m.roughness = 0;
  d.scene = std::make_shared<const scene::Scene>(std::move(scene));
  return d;
}

render::Document with(const render::Document& d, const char* name, const std::string& value) {
  auto changed = render::with_text(d, name, value);
  EXPECT_TRUE(changed) << changed.error().message;
  return changed ? *changed : d;
}

render::Document restricted_to(const render::Document& d, const std::string& paths) {
  return with(d, "film.paths", paths);
}

constexpr const char* kMethods[] = {"path", "path-pure", "raycast", "appel", "whitted", "distribution"};

using Partition = std::vector<std::string>;
const std::vector<Partition> kPartitions{
    {"EL", "E(D|G)L", "E(D|G).+L", "ES.*L"},
    {"EL", "ED.*L", "EG.*L", "ES.*L"},
    {"EL", "E.*DL", "E.*GL", "E.*SL"},
    {"ED*L", "E.*G.*L", "ED*S(D|S)*L"},
};

TEST(Classes, AllPathsGiveTheFullImageBitForBit) {
  for (const auto& d : {cornell(), test::glossy_scene(), glazed()})
    for (const char* integrator : kMethods) {
      const auto document = with(d, "render.integrator", integrator);
      const auto whole = test::rendered(document, 16);
      EXPECT_TRUE(same_bits(whole, test::rendered(restricted_to(document, "E(D|G|S)*L"), 16))) << integrator;
      EXPECT_TRUE(same_bits(whole, test::rendered(with(document, "model.classes", "on"), 16))) << integrator;
      const auto any = restricted_to(document, "[E.+L|EL]");
      EXPECT_TRUE(same_bits(whole, test::rendered(with(any, "model.classes", "on"), 16))) << integrator;
    }
}

TEST(Classes, PartitionsSumForEachSample) {
  for (const auto& d : {cornell(), test::glossy_scene(), glazed()})
    for (const char* integrator : kMethods)
      for (const Partition& partition : kPartitions) {
        const auto document = with(d, "render.integrator", integrator);
        const auto whole = test::rendered(document, 16);
        std::vector<film::Film> parts;
        for (const auto& paths : partition) parts.push_back(test::rendered(restricted_to(document, paths), 16));
        for (int y = 0; y < d.height; ++y)
          for (int x = 0; x < d.width; ++x)
            for (int c = 0; c < 3; ++c) {
              double sum = 0;
              for (const auto& part : parts) sum += double{part.mean(x, y)[c]};
              const double expected = double{whole.mean(x, y)[c]};
              ASSERT_NEAR(sum, expected, 2e-5 * expected + 1e-7)
                  << integrator << ' ' << partition[1] << ' ' << x << ' ' << y;
            }
      }
}

// The same in expectation, with a different seed for each part.
TEST(Classes, PartitionsSumInExpectation) {
  for (const auto& d : {cornell(), test::glossy_scene()})
    for (const Partition& partition : {kPartitions[0], kPartitions[1]}) {
      const auto whole = replicated(d, 64, 1);
      auto sum = replicated(restricted_to(d, partition[0]), 64, 100);
      for (size_t i = 1; i < partition.size(); ++i)
        sum = sum + replicated(restricted_to(d, partition[i]), 64, 100 * (i + 1));
      expect_agreement(sum, whole, partition[1], 4);
    }
}

// Path tracing without connections classifies a vertex by the sampled lobe, next event estimation by the evaluated
// lobes. Both agree for every class.
TEST(Classes, IntegratorsAgreeForEachClass) {
  const auto d = test::glossy_scene();
  for (const char* paths : {"EDL", "EGL", "E(D|G)DL", "EDGL", "E.*DS+L", "ES+.*L"}) {
    const auto filtered = restricted_to(d, paths);
    const auto path = replicated(with(filtered, "render.integrator", "path"), 128);
    EXPECT_GT(*std::max_element(path.mean.begin(), path.mean.end()), 0) << paths;
    expect_agreement(path, replicated(with(filtered, "render.integrator", "path-pure"), 256, 2000), paths, 6);
  }
}

// A sphere of glazed clay under an area light.
render::Document clay_ball(const Rgb& base, float roughness) {
  scene::Scene scene;
  Material clay;
  clay.base_color = base;
  clay.metallic = 0;
  clay.roughness = roughness;
  test::add(scene, test::sphere(1, 32, false), clay);
  Mat4 above(1);
  above[1][1] = -1;
  above[2][2] = -1;
  above[3] = Vec4(1, 3, 1, 1);
  test::add(scene, test::quad(1), test::diffuse(Rgb(0), Rgb(5)), above);
  return test::document(scene, look_at({0, 1, 4}, {0, 0, 0}, {0, 1, 0}, 0.6f), test::kSize, test::kSize);
}

// Over a black base only the coat reflects, and its contribution does not depend on the base.
TEST(Classes, GlossyPartEqualsTheImageWithABlackBase) {
  const auto whole = clay_ball({0.8f, 0.6f, 0.3f}, 0.4f), layer = clay_ball(Rgb(0), 0.4f);
  expect_agreement(replicated(restricted_to(whole, "EGL"), 64), replicated(restricted_to(layer, "E(D|G)L"), 64, 2000),
                   "layer", 2);
  expect_agreement(replicated(restricted_to(layer, "EDL"), 4), replicated(restricted_to(layer, "EDGL"), 4), "nothing",
                   2);
}

// In a closed room of albedo a and emission one, the paths with n reflections have radiance a^n.
TEST(Classes, FurnaceByNumberOfReflections) {
  constexpr float kAlbedo = 0.5f;
  const auto d = test::document(test::furnace(kAlbedo), look_at({0, 0, 0}, {1, 0.2f, 0.3f}, {0, 1, 0}, 0.8f), 16, 16);
  std::string paths = "E";
  for (int n = 0; n <= 5; ++n) {
    for (const char* integrator : {"path", "path-pure"}) {
      const auto film = test::rendered(restricted_to(with(d, "render.integrator", integrator), paths + "L"), 64);
      const auto mean = test::mean_of(film);
      // 12 comparisons with a common false-alarm rate of 1 %.
      EXPECT_NEAR(mean.value, std::pow(double{kAlbedo}, n), 3.4 * mean.standard_error + 1e-5) << integrator << ' ' << n;
    }
    paths += "D";
  }
}

// A lossless mirror and a clear glass ball in an environment of radiance one keep that radiance, and all scattering is
// specular.
TEST(Classes, MirrorsAndClearGlassAreSpecular) {
  Material mirror, glass;
  mirror.base_color = Rgb(1);
  mirror.metallic = 1;
  mirror.roughness = 0;
  glass.metallic = 0;
  glass.roughness = 0;
  glass.transmission = 1;
  glass.thickness = 1;
  for (const auto& [material, paths] : {std::pair(mirror, "ESL"), std::pair(glass, "ES+L")}) {
    scene::Scene scene;
    test::add(scene, test::sphere(1, 64, false), material);
    scene.environment.tint = Rgb(1);
    // The sphere fills the image.
    const auto d = test::document(scene, look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.2f), 16, 16);
    for (const char* integrator : {"path", "path-pure"}) {
      const auto document = with(d, "render.integrator", integrator);
      const auto specular = test::mean_of(test::rendered(restricted_to(document, paths), 256));
      EXPECT_NEAR(specular.value, 1, 4 * specular.standard_error + 2e-3) << paths << ' ' << integrator;
      EXPECT_EQ(test::mean_of(test::rendered(restricted_to(document, "E.*(D|G).*L|EL"), 16)).value, 0) << paths;
    }
  }
}

TEST(Classes, PathsEndWhenTheirClassIsDecided) {
  const auto rays = [](const render::Document& d) {
    render::Document limited = d;
    limited.limits = {4, 0, 0};
    render::Session session({.threads = 1, .interactive = false});
    session.submit(limited);
    session.finish();
    return session.status().rays;
  };
  const auto d = cornell();
  const uint64_t camera = 4 * test::kSize * test::kSize;
  EXPECT_EQ(rays(restricted_to(d, "EL")), camera);
  EXPECT_EQ(rays(restricted_to(d, "ES.*L")), camera);
  EXPECT_LE(rays(restricted_to(d, "EDL")), 3 * camera);
  EXPECT_LT(rays(restricted_to(d, "EDDL")), rays(d));
}

TEST(Classes, RegistryDeclaresValidExpressions) {
  for (const auto& info : integrator::integrator_infos()) {
    EXPECT_TRUE(transport::PathExpression::parse_paths(info.paths)) << info.name << ' ' << info.paths;
    EXPECT_TRUE(integrator::finds_any(info.paths, ""));
    EXPECT_TRUE(integrator::finds_any(info.paths, info.paths));
  }
  const auto* raycast = integrator::find_integrator("raycast");
  EXPECT_FALSE(integrator::finds_any(raycast->paths, "EDD+L"));
  EXPECT_TRUE(integrator::finds_any(raycast->paths, "ED*L"));
  const auto d = restricted_to(with(cornell(), "render.integrator", "raycast"), "EDD+L");
  EXPECT_EQ(test::mean_of(test::rendered(d, 4)).value, 0);
}

TEST(Classes, ExpressionIsADocumentParameter) {
  const auto d = restricted_to(cornell(), "ED S* L");
  const auto again = render::document_from_state(render::state_json(d, 1), "test");
  ASSERT_TRUE(again);
  EXPECT_EQ(again->method.paths, "ED S* L");
  EXPECT_EQ(std::get<std::string>(*render::get(d, "film.paths")), "ED S* L");
  EXPECT_TRUE(with(d, "film.paths", "").method.paths.empty());
  const auto wrong = render::with_text(d, "film.paths", "E(DL");
  ASSERT_FALSE(wrong);
  EXPECT_TRUE(wrong.error().message.starts_with("film.paths: ")) << wrong.error().message;
  EXPECT_EQ(wrong.error().fault, Fault::usage);
}

}  // namespace
}  // namespace etendue::classes_test
