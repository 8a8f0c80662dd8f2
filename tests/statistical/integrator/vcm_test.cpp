// Vertex connection and merging: closed forms, and agreement with the integrators whose techniques it combines. t-tests
// with a false-alarm rate of 1 % per test. Merges are biased; their radii are so small that noise hides the bias.
#include <gtest/gtest.h>

#include "support/independent_estimates.h"
#include "support/integrator_scenes.h"
#include "support/translation.h"

namespace etendue::vcm_test {
namespace {

using render::Document;
using test::expect_same_mean;
using test::with;
using test::with_integrator;

Document merging(const Document& place, const char* radius) {
  return with(with(with_integrator(place, "vcm"), "radius", radius), "alpha", "1");
}

// The light of the wall is uniform, and a chord of length r spans a cap of the area pi r^2, so merges have no bias except
// at the light and by MIS weights that change within the radius. Merges have about 0.7 times the density of connections.
TEST(VertexMerging, IntegratingSphere) {
  constexpr double kShare = 0.1, kAlbedo = 0.5, kMean = kShare * kAlbedo / (1 - kAlbedo);
  const Document place =
      with(test::integrating_sphere(kShare, kAlbedo, scene::Cap::reflecting, 32), "film.paths", "ED.*L");
  const test::Mean mean = test::mean_of(test::rendered(merging(place, "0.9"), 64));
  EXPECT_NEAR(mean.value, kMean, 4 * mean.standard_error + 2e-3 * kMean);
  EXPECT_LT(mean.standard_error, 0.005 * kMean);
}

// Without merges, all weights are those of bidirectional path tracing.
TEST(VertexMerging, WithoutARadiusIsBidirectional) {
  const Document place = test::balls_under_area_light();
  const auto connected = test::rendered(with(with_integrator(place, "bdpt"), "film.paths", "E.*L"), 4);
  const auto merged = test::rendered(with(merging(place, "0.002"), "film.paths", "E.*L"), 4);
  for (int y = 0; y < place.height; ++y)
    for (int x = 0; x < place.width; ++x)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(merged.mean(x, y)[c], connected.mean(x, y)[c], 1e-3f * connected.mean(x, y)[c] + 1e-6f);
}

TEST(VertexMerging, AgreesWithPathTracing) {
  const Document area = test::balls_under_area_light(), sky = test::balls_under_sky();
  for (const char* radius : {"0.2", "0.6"}) {
    expect_same_mean(with_integrator(area, "path"), 512, merging(area, radius), 128, "area light", 4);
    expect_same_mean(with_integrator(sky, "path"), 512, merging(sky, radius), 128, "sky", 4);
  }
}

// A ball of clay, and a small light that a floor of polished metal (roughness 0.15) reflects.
Document light_above_metal() {
  scene::Scene scene;
  Material metal;
  metal.base_color = Rgb(0.8f);
  metal.metallic = 1;
  metal.roughness = 0.15f;
  Mat4 above(1);
  above[1][1] = -1;
  above[2][2] = -1;
  above[3] = Vec4(0.3f, 2, -1.5f, 1);
  test::add(scene, test::quad(4), metal);
  test::add(scene, test::sphere(0.5f, 8, false), test::diffuse(Rgb(0.5f)), test::at({-0.8f, 0.5f, 0}));
  test::add(scene, test::quad(0.2f), test::diffuse(Rgb(0.3f), Rgb(20)), above);
  return test::view_from_above(std::move(scene));
}

// The weights of all techniques sum to 1 where some vertices of a path are merged and others are not.
TEST(VertexMerging, AgreesWithPathTracingOnPolishedMetal) {
  const Document d = light_above_metal();
  expect_same_mean(with_integrator(d, "path"), 1024, merging(d, "0.3"), 128, "polished metal", 1);
}

// Merges would blur the reflection of the light; the limit of the roughness excludes them there.
TEST(VertexMerging, PolishedMetalReflectsSharply) {
  const Document d = light_above_metal();
  const auto reference = test::rendered(with_integrator(d, "path"), 4096);
  const auto squared_error = [&](const char* roughness) {
    const auto film = test::rendered(with(merging(d, "2"), "roughness", roughness), 64);
    double sum = 0;
    for (int y = 0; y < d.height; ++y)
      for (int x = 0; x < d.width; ++x) sum += sqr(double{film.mean(x, y).g} - double{reference.mean(x, y).g});
    return sum;
  };
  const double limited = squared_error("0.2"), everywhere = squared_error("0");
  RecordProperty("ratio", std::to_string(limited / everywhere));
  EXPECT_LT(limited, 0.25 * everywhere);
}

// A wide lens can be hit by light paths.
TEST(VertexMerging, AgreesWithPathTracingThroughALens) {
  const Document d = test::with_lens(test::balls_under_area_light());
  expect_same_mean(with_integrator(d, "path"), 512, merging(d, "0.4"), 128, "lens", 1);
}

TEST(VertexMerging, PathClassesAgree) {
  const Document d = test::balls_under_area_light();
  for (const char* paths : {"EL", "EDL", "E(D|G)S+L|E.*DS+DL", "ED.*GL|ES.*L", "E.G.*L"})
    expect_same_mean(with_integrator(with(d, "film.paths", paths), "path"), 512,
                     merging(with(d, "film.paths", paths), "0.3"), 128, paths, 5);
}

// A point light above a slab of glass, and a floor that is seen through the slab: neither subpath hits the end of the
// other, so connections alone find nothing.
TEST(VertexMerging, FindsCausticsSeenThroughGlass) {
  Material glass;
  glass.metallic = glass.roughness = 0;
  glass.transmission = glass.thickness = 1;
  scene::Scene scene;
  test::add(scene, test::quad(2), test::diffuse(Rgb(0.5f)));
  test::add(scene, scene::box({3, 0.4f, 3}), glass, test::at({0, 0.5f, 0}));
  test::add_point_light(scene, {0.3f, 2.5f, 0.2f}, 4);
  const Document d = with(test::view_from_above(std::move(scene)), "film.paths", "ESSDSSL");
  const auto mean = [](const Document& document, uint32_t samples) {
    return test::mean_of(test::rendered(document, samples)).value;
  };
  const double expected = mean(with(with(with_integrator(d, "sppm"), "radius", "0.5"), "photons", "20000"), 256);
  EXPECT_EQ(mean(with_integrator(d, "bdpt"), 16), 0);
  EXPECT_NEAR(mean(merging(d, "0.4"), 1024), expected, 0.04 * expected);
}

// The radius shrinks, and with it the blur of a caustic.
TEST(VertexMerging, BiasFallsAsTheRadiusShrinks) {
  Document d = with(with(test::cornell(24), "film.paths", "ED.*L"), "path.max-depth", "3");
  const auto reference = test::rendered(with_integrator(d, "path"), 4096);
  const auto squared_error = [&](const char* radius) {
    const auto film = test::rendered(with(merging(d, radius), "max-depth", "3"), 512);
    double sum = 0;
    for (int y = 0; y < d.height; ++y)
      for (int x = 0; x < d.width; ++x) sum += sqr(double{film.mean(x, y).g} - double{reference.mean(x, y).g});
    return sum;
  };
  EXPECT_LT(squared_error("0.6"), 0.5 * squared_error("3"));
}

}  // namespace
}  // namespace etendue::vcm_test
