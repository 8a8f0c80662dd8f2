// Learned choices of lights: unbiased, and without the noise of a strong light that walls hide.
#include <gtest/gtest.h>

#include <numeric>

#include "scene/builtin/lathe.h"
#include "scene/builtin/scene_builder.h"
#include "support/integrator_scenes.h"
#include "support/scenes.h"

namespace etendue::learned_lights_test {
namespace {

using render::Document;

// A closed room with a light inside. The sun outside has this illuminance; 0: none.
Document room(double sun) {
  Document d = *render::new_document("door-ajar");
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  scene::add(*scene, "ball light", scene::ball(0.1f, 8), scene::add_emitter(*scene, "ball light", Rgb(50)),
             scene::translated(Vec3(-1, 2.2f, 1.5f)));
  if (sun > 0) {
    Light light = make_light("directional");
    light.set("intensity", sun);
    scene::Transform place;
    place.matrix = look_at(Vec3(0), {0.3f, -1, 0.2f}, {0, 0, 1}, 1).to_world;
    test::add(*scene, light, place);
  }
  d.scene = scene;
  d.width = d.height = test::kSize;
  return d;
}

test::Estimate image(const Document& d, const char* integrator, const char* lights, uint64_t seed) {
  return test::replicated(test::with(test::with_integrator(d, integrator), "lights", lights), 64, seed);
}

double variance_of(const test::Estimate& e) { return std::accumulate(e.variance.begin(), e.variance.end(), 0.0); }

// By power, nearly all light samples would go to the sun, which reaches no surface inside. The learned choice loses at most
// the share that every group keeps.
TEST(LearnedLights, ASunOutsideAClosedRoomAddsNoNoise) {
  for (const char* integrator : {"path", "distribution"}) {
    const auto without = image(room(0), integrator, "auto", 1000);
    const auto learned = image(room(10'000), integrator, "auto", 2000);
    const auto by_power = image(room(10'000), integrator, "one", 3000);
    test::expect_agreement(without, learned, integrator, 2);
    EXPECT_LT(variance_of(learned), 1.5 * variance_of(without)) << integrator;
    EXPECT_GT(variance_of(by_power), 10 * variance_of(without)) << integrator;
  }
}

// Light subpaths choose by power, light samples by what was learned. Whichever techniques are left, the weights of all paths
// sum to one.
TEST(LearnedLights, BidirectionalTechniquesAgree) {
  const Document d = test::with(room(1000), "film.paths", "E(D|G)*L");
  const auto expected = image(d, "path", "auto", 4000);
  EXPECT_LT(4 * variance_of(expected), variance_of(image(d, "path", "one", 6000))) << "nothing was learned";
  for (const char* without : {"", "0,*", "1,*", "*,1", "2,*", "*,2"}) {
    const Document bdpt = test::with(test::with_integrator(d, "bdpt"), "without", without);
    test::expect_agreement(expected, test::replicated(bdpt, 128, 5000), without, 6);
  }
}

}  // namespace
}  // namespace etendue::learned_lights_test
