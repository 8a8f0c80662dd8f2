// Light adds up: the image of two lights is the sum of the images of each, for every integrator without bias, whatever
// paths it samples. The emitters of a scene change how integrators choose lights and directions, so both sides use
// different densities.
//
// The false-alarm rate is 1 % for all blocks of all integrators of a scene.
#include <gtest/gtest.h>

#include "integrator/integrator.h"
#include "render/incompatibility.h"
#include "scene/compiled_scene.h"
#include "support/integrator_scenes.h"

namespace etendue::superposition {
namespace {

using render::Document;

// The document without the emission of surfaces, or without the environment and the placed lights.
Document without_area_lights(const Document& d) {
  scene::Scene scene = *d.scene;
  for (Material& material : scene.materials) material.emission = Rgb(0);
  Document changed = d;
  changed.scene = std::make_shared<const scene::Scene>(std::move(scene));
  return changed;
}
Document without_environment(const Document& d) {
  scene::Scene scene = *d.scene;
  scene.environment.tint = Rgb(0);
  Document changed = d;
  changed.scene = std::make_shared<const scene::Scene>(std::move(scene));
  return changed;
}

// Integrators without bias that find light of both parts. Markov chains are unbiased with enough bootstrap samples.
std::vector<Document> integrators_for(const Document& place) {
  const auto scene = scene::compile(place.scene, place.camera, nullptr);
  std::vector<Document> found;
  for (const auto& info : integrator::integrator_infos()) {
    const bool is_markov_chain = info.group == integrator::Group::markov_chain;
    if (info.bias != integrator::Bias::unbiased && !is_markov_chain) continue;
    Document d = test::with_integrator(place, info.name);
    if (is_markov_chain) d = test::with(d, "chains", "32");
    if (render::incompatibility(d, *scene).empty()) found.push_back(std::move(d));
  }
  return found;
}

uint32_t samples_of(const Document& d) {
  const std::string& name = d.method.integrator;
  return name == "light-pure" ? 512 : name == "light" || name == "path-pure" ? 128 : 32;
}

void expect_superposition(const Document& place) {
  const std::vector<Document> documents = integrators_for(place);
  ASSERT_GE(documents.size(), 8U);
  for (const Document& d : documents) {
    const uint32_t samples = samples_of(d);
    const auto both = test::replicated(d, samples, 1000);
    const auto sum = test::replicated(without_environment(d), samples, 2000) +
                     test::replicated(without_area_lights(d), samples, 3000);
    test::expect_agreement(both, sum, d.method.integrator, static_cast<int>(documents.size()));
  }
}

Document lit_by_area_light_and_sky(Document d) {
  scene::Scene scene = *d.scene;
  scene.environment.tint = {0.2f, 0.4f, 0.9f};
  d.scene = std::make_shared<const scene::Scene>(std::move(scene));
  return d;
}

TEST(Superposition, AreaLightAndSky) {
  expect_superposition(lit_by_area_light_and_sky(test::balls_under_area_light()));
}

// Other images have another sum: the test can fail.
TEST(Superposition, APartIsNotTheWhole) {
  const Document d = lit_by_area_light_and_sky(test::balls_under_area_light());
  const auto mean = [](const test::Estimate& e) {
    double sum = 0;
    for (const double v : e.mean) sum += v;
    return sum / static_cast<double>(e.mean.size());
  };
  const double both = mean(test::replicated(d, 16)), lamp = mean(test::replicated(without_environment(d), 16)),
               sky = mean(test::replicated(without_area_lights(d), 16));
  EXPECT_GT(both, 1.1 * lamp);
  EXPECT_GT(both, 1.1 * sky);
}

}  // namespace
}  // namespace etendue::superposition
