// Light selection strategies: all give the same image; the light tree gives less noise.
#include <gtest/gtest.h>

#include "scene/builtin/many_lights.h"
#include "support/integrator_scenes.h"

namespace etendue::many_lights_test {
namespace {

using render::Document;

Document hall(int light_count) {
  Document d = *render::new_document("many-lights");
  d.scene = std::make_shared<const scene::Scene>(scene::hall_of_lights(light_count));
  d.width = d.height = test::kSize;
  return test::with(d, "film.paths", "E(D|G).*L");
}

TEST(ManyLights, AllStrategiesGiveTheSameImage) {
  const Document d = hall(24);
  const auto power = test::replicated(test::with(test::with_integrator(d, "path"), "path.lights", "one"), 256, 1000);
  const auto tree = test::replicated(test::with(test::with_integrator(d, "path"), "path.lights", "tree"), 64, 2000);
  const auto every =
      test::replicated(test::with(test::with_integrator(d, "distribution"), "distribution.lights", "every"), 8, 3000);
  const auto both_ways = test::replicated(test::with_integrator(d, "bdpt"), 64, 4000);
  test::expect_agreement(power, tree, "power and tree", 4);
  test::expect_agreement(every, tree, "every and tree", 4);
  test::expect_agreement(every, power, "every and power", 4);
  test::expect_agreement(both_ways, tree, "bdpt and tree", 4);
}

// The hall under a sky.
Document hall_under_sky() {
  Document d = hall(24);
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  scene->environment.tint = {0.05f, 0.06f, 0.08f};
  d.scene = scene;
  return test::with(d, "film.paths", "E.*L");
}

// Light samples of `bdpt` choose by the tree, light subpaths by power. Whichever techniques are left, the weights of all
// paths sum to one.
TEST(ManyLights, BidirectionalTechniquesAgree) {
  const Document places[] = {hall_under_sky(), test::with_lens(hall_under_sky())};
  for (const Document& place : places) {
    const auto expected = test::replicated(test::with_integrator(place, "path"), 256, 5000);
    const Document d = test::with_integrator(place, "bdpt");
    for (const char* without : {"", "0,*", "1,*", "*,1", "2,*", "*,2"})
      test::expect_agreement(expected, test::replicated(test::with(d, "without", without), 128, 6000), without, 18);
    for (const char* heuristic : {"balance", "maximum"})
      test::expect_agreement(expected, test::replicated(test::with(d, "heuristic", heuristic), 128, 7000), heuristic,
                             18);
    const Document merging = test::with(test::with_integrator(place, "vcm"), "radius", "0.2");
    test::expect_agreement(expected, test::replicated(merging, 128, 8000), "vcm", 18);
  }
}

// Mutations of `mlt` connect a vertex to a light that is chosen for it by the tree.
TEST(ManyLights, MetropolisMutationsAgree) {
  for (const Document& place : {hall(24), hall_under_sky(), test::with_lens(hall_under_sky())}) {
    Document d = test::with(test::with_integrator(place, "mlt"), "candidates", "4096");
    for (const char* other : {"lens-perturbation", "caustic-perturbation", "multi-chain", "lens-subpath"})
      d = test::with(d, other, "0");
    const auto expected = test::replicated(test::with_integrator(place, "path"), 256, 9000);
    test::expect_agreement(expected, test::replicated(test::with(d, "chains", "128"), 256, 10000), "mlt", 3);
  }
}

double error_of(const Document& d, const std::string& lights) {
  const auto estimate = test::replicated(test::with(test::with_integrator(d, "path"), "path.lights", lights), 16);
  double sum = 0;
  for (const double v : estimate.variance) sum += v;
  return sum;
}

// The bound is far below the measured factor of ten (docs/results/lights.md), so that chance cannot decide.
TEST(ManyLights, LightTreeHasLessNoise) {
  const Document d = hall(300);
  EXPECT_LT(3 * error_of(d, "tree"), error_of(d, "one"));
  EXPECT_EQ(error_of(d, "auto"), error_of(d, "tree"));
}

// By power, the light samples of `bdpt` would be as noisy as those of `path`, and its other techniques find little here.
TEST(ManyLights, BidirectionalLightSamplesUseTheTree) {
  const Document d = test::with(hall(300), "film.paths", "E(D|G)L");
  const auto estimate = test::replicated(test::with_integrator(d, "bdpt"), 16);
  double sum = 0;
  for (const double v : estimate.variance) sum += v;
  EXPECT_LT(2 * sum, error_of(d, "one"));
}

}  // namespace
}  // namespace etendue::many_lights_test
