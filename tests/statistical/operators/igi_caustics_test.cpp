// Virtual lights with a caustics map: the light that virtual lights miss is added once.
#include <gtest/gtest.h>

#include <cmath>

#include "render/incompatibility.h"
#include "scene/compiled_scene.h"
#include "support/integrator_scenes.h"

namespace etendue::igi_caustics {
namespace {

using render::Document;
using test::with;

constexpr const char* kCaustics = "ES*(D|G)S+L";

double mean(const Document& d, uint32_t samples) {
  return double{luminance(test::mean_color(test::rendered(d, samples)))};
}
Document igi(const Document& d, const char* photons) {
  return with(with(with(test::with_integrator(d, "igi"), "light-paths", "32"), "full-bsdf", "on"), "caustic-photons",
              photons);
}

// The density estimate blurs the caustic but keeps its power. The standard error of the reference is 1.7 %.
TEST(IgiWithCaustics, AddsTheMissingClass) {
  Document d = *render::new_document("cornell-spheres");
  d.width = d.height = 16;
  d = with(d, "film.paths", kCaustics);
  const double expected = mean(d, 16'384);
  EXPECT_EQ(mean(igi(d, "0"), 4), 0);
  EXPECT_NEAR(mean(with(igi(d, "2000000"), "renew", "off"), 32), expected, 0.05 * expected);
}

// Without a map, an image of caustics alone is black, and the message says so.
TEST(IgiWithCaustics, AMapMakesItCompatibleWithCaustics) {
  const Document d = with(test::balls_under_area_light(), "film.paths", kCaustics);
  const auto reason = [](const Document& document) {
    return render::incompatibility(document, *scene::compile(document.scene, document.camera, nullptr));
  };
  EXPECT_NE(reason(igi(d, "0")).find("none of ES*(D|G)S+L: the image will be black"), std::string::npos);
  EXPECT_EQ(reason(igi(d, "20000")), "");
}

// All other classes are those of igi without a map, bit for bit.
TEST(IgiWithCaustics, DoesNotChangeOtherClasses) {
  const Document d = with(test::balls_under_area_light(), "film.paths", "E(D|G).*(D|G)L");
  const auto plain = test::rendered(igi(d, "0"), 4), hybrid = test::rendered(igi(d, "20000"), 4);
  EXPECT_TRUE(test::same_bits(plain, hybrid));
}

// Scenes without mirrors and glass need no map.
TEST(IgiWithCaustics, DiffuseScenesAreUnchanged) {
  const Document d = test::cornell(16);
  EXPECT_TRUE(test::same_bits(test::rendered(igi(d, "0"), 2), test::rendered(igi(d, "20000"), 2)));
}

}  // namespace
}  // namespace etendue::igi_caustics
