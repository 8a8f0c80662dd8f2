// Layers of light paths that are recorded with the image: they partition it sample by sample, and each one is the image
// of its path class.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/light_path_layers.h"
#include "render/session.h"
#include "scene/compiled_scene.h"
#include "support/integrator_scenes.h"
#include "support/scattering_scenes.h"

namespace etendue::path_layers {
namespace {

using render::Document;
using test::with;
using test::with_integrator;

struct Layered {
  film::Film film;
  std::vector<image::Layer> layers;

  const std::vector<float>& layer(const std::string& name) const {
    const auto found = std::ranges::find_if(layers, [&](const auto& layer) { return layer.name == name; });
    EXPECT_NE(found, layers.end()) << name;
    return found->pixels;
  }
};

Layered layered(Document d, const std::vector<std::string>& names, uint32_t samples) {
  d.limits = {samples, 0, 0};
  auto recording = render::record_light_path_layers(d, names);
  EXPECT_TRUE(recording) << recording.error().message;
  render::Session session({.threads = 2});
  render::ResumePoint start{film::Film(d.width, d.height)};
  start.layers = *recording;
  session.submit(d, std::move(start));
  session.finish();
  return {session.film_copy(), render::layers_of(**recording)};
}

double channel(const film::Film& film, size_t i) {
  const auto pixel = static_cast<int>(i / 3), width = film.width();
  return double{film.mean(pixel % width, pixel / width)[static_cast<int>(i % 3)]};
}

void expect_equal(const film::Film& film, const std::vector<const std::vector<float>*>& layers, const std::string& what,
                  double tolerance = 2e-5) {
  double total = 0;
  for (size_t i = 0; i < layers[0]->size(); ++i) {
    double sum = 0;
    for (const auto* layer : layers) sum += double{(*layer)[i]};
    const double expected = channel(film, i);
    ASSERT_NEAR(sum, expected, tolerance * std::abs(expected) + 1e-6) << what << ", value " << i;
    total += expected;
  }
  EXPECT_GT(total, 0) << what;
}

void expect_partition(const Layered& image, const std::vector<std::string>& names, const std::string& what) {
  std::vector<const std::vector<float>*> parts;
  for (const std::string& name : names) parts.push_back(&image.layer(name));
  expect_equal(image.film, parts, what);
}

Document cornell() {
  auto d = *render::new_document("cornell");
  d.width = d.height = test::kSize;
  return d;
}
Document builtin(const char* name) {
  auto d = *render::new_document(name);
  d.width = 24;
  d.height = 16;
  return d;
}

const std::vector<std::string> kBounces{"bounce-0", "bounce-1", "bounce-2", "bounce-3", "bounce-rest"};
const std::vector<std::string> kSums{"emission", "direct", "indirect"};
const std::vector<std::string> kPhotonTerms{"photon-emission", "photon-direct", "photon-glossy", "photon-caustics",
                                            "photon-indirect"};

struct Case {
  const char* name;
  Document document;
  bool has_extended_lights = true;  // which paths without light samples find
};
std::vector<const char*> integrators_for(const Case& c) {
  return c.has_extended_lights ? std::vector{"path", "path-pure"} : std::vector{"path"};
}
std::vector<Case> cases() {
  return {{"cornell", cornell()},
          {"glossy", test::glossy_scene()},
          {"analytic lights", test::balls_under_analytic_lights()},
          {"all lights", with(test::balls_under_analytic_lights(), "path.lights", "every")},
          {"fog", builtin("fog")},
          {"spot light in fog", test::spot_light_in_fog(), false},
          {"wax", builtin("wax")},
          {"prism", builtin("prism")}};
}

TEST(PathLayers, SetsSumToTheImage) {
  for (const Case& c : cases())
    for (const char* integrator : integrators_for(c)) {
      const Layered image =
          layered(with_integrator(c.document, integrator), {"bounces", "direct-indirect", "photon-terms"}, 8);
      const std::string what = std::string(c.name) + " " + integrator;
      expect_partition(image, kBounces, what);
      expect_partition(image, kSums, what);
      expect_partition(image, kPhotonTerms, what);
    }
}

// Media that emit: with path classes, light samples do not find them.
TEST(PathLayers, SetsSumToTheImageOfAnEmittingMedium) {
  const Layered image = layered(builtin("fire"), {"bounces", "photon-terms"}, 8);
  expect_partition(image, kBounces, "fire");
  expect_partition(image, kPhotonTerms, "fire");
}

// The same paths as without layers, except for light samples in emitting media.
TEST(PathLayers, TheImageIsThatWithoutLayers) {
  for (const Case& c : cases())
    for (const char* integrator : integrators_for(c)) {
      const Document d = with_integrator(c.document, integrator);
      const film::Film plain = test::rendered(d, 8);
      const Layered image = layered(d, {"bounces"}, 8);
      std::vector<float> values;
      for (size_t i = 0; i < image.layers[0].pixels.size(); ++i)
        values.push_back(static_cast<float>(channel(image.film, i)));
      expect_equal(plain, {&values}, std::string(c.name) + " " + integrator, 1e-4);
    }
}

// A path class that is recorded is the image of film.paths; a number of bounces is a path class as well.
TEST(PathLayers, LayersAreTheImagesOfTheirClasses) {
  const std::vector<std::pair<std::string, std::string>> classes{{"bounce-1", "E.L"},
                                                                 {"bounce-2", "E..L"},
                                                                 {"indirect", "E...*L"},
                                                                 {"photon-direct", "ES*(D|G|V)L"},
                                                                 {"photon-caustics", "ES*(D|V)S+L"},
                                                                 {"own", "ED.*L"}};
  for (const Case& c : cases()) {
    const Layered image =
        layered(c.document, {"bounces", "indirect", "photon-direct", "photon-caustics", "own=ED.*L"}, 8);
    for (const auto& [name, paths] : classes) {
      const film::Film alone = test::rendered(with(c.document, "film.paths", paths), 8);
      const std::vector<float>& layer = image.layer(name);
      for (size_t i = 0; i < layer.size(); ++i)
        ASSERT_NEAR(double{layer[i]}, channel(alone, i), 1e-4 * std::abs(channel(alone, i)) + 1e-5)
            << c.name << ' ' << name << ", value " << i;
    }
  }
}

// film.paths restricts the image and its layers alike.
TEST(PathLayers, FilmPathsRestrictTheLayers) {
  const Document d = with(test::glossy_scene(), "film.paths", "E(D|G).*L");
  const Layered image = layered(d, {"bounces:2", "diffuse=ED.*L", "glossy=EG.*L", "mirror=ES.*L"}, 8);
  expect_partition(image, {"bounce-0", "bounce-1", "bounce-rest"}, "bounces");
  expect_partition(image, {"diffuse", "glossy"}, "classes");
  EXPECT_TRUE(std::ranges::all_of(image.layer("mirror"), [](float v) { return v == 0; }));
  EXPECT_TRUE(std::ranges::all_of(image.layer("bounce-0"), [](float v) { return v == 0; }));
  expect_equal(test::rendered(d, 8), {&image.layer("diffuse"), &image.layer("glossy")}, "image", 1e-4);
}

// A layer has the same bits for any number of threads.
TEST(PathLayers, DoNotDependOnThreads) {
  const Document d = cornell();
  const auto scene = scene::compile(d.scene, d.camera, nullptr);
  const std::vector<std::string> names{"bounces"};
  const auto one = render::render_light_path_layers(scene, d, names, 4, 1),
             two = render::render_light_path_layers(scene, d, names, 4, 2);
  ASSERT_EQ(one.size(), 5U);
  for (size_t k = 0; k < one.size(); ++k) EXPECT_EQ(one[k].pixels, two[k].pixels);
}

TEST(PathLayers, WrongNamesAreErrors) {
  const auto error_of = [](const Document& d, const std::string& name) {
    const std::vector<std::string> names{name};
    const auto recording = render::record_light_path_layers(d, names);
    return recording ? std::string() : recording.error().message;
  };
  const Document d = cornell();
  EXPECT_EQ(error_of(d, "bounces"), "");
  EXPECT_NE(error_of(d, "bounces:0").find("from 1 to 64"), std::string::npos);
  EXPECT_NE(error_of(d, "bounces:x").find("from 1 to 64"), std::string::npos);
  EXPECT_NE(error_of(d, "a.b=EL").find("no name of a layer"), std::string::npos);
  EXPECT_NE(error_of(d, "own=EX").find("own:"), std::string::npos);
  EXPECT_NE(error_of(with_integrator(d, "bdpt"), "bounces").find("recorded by the integrators path"),
            std::string::npos);
  EXPECT_NE(error_of(with(d, "render.adaptive", "rmse"), "bounces").find("render.adaptive"), std::string::npos);
}

}  // namespace
}  // namespace etendue::path_layers
