// Path tracing with manifold next event estimation: closed forms of mirrors and lenses, agreement with other unbiased
// integrators, and independence of the number of threads.
#include <gtest/gtest.h>

#include "advisor/declared_paths.h"
#include "integrator/manifold/walk_weights.h"
#include "support/independent_estimates.h"
#include "support/integrator_scenes.h"
#include "support/resume.h"
#include "support/scenes.h"

namespace etendue::manifold_test {
namespace {

using render::Document;
using test::with_integrator;

constexpr float kAlbedo = 0.5f;

Material mirror() {
  Material m = test::diffuse(Rgb(1));
  m.metallic = 1;
  m.roughness = 0;
  return m;
}

// A diffuse floor with a vertical mirror behind it, seen from above. A light is to be added.
scene::Scene floor_and_mirror() {
  scene::Scene scene;
  test::add(scene, test::quad(1), test::diffuse(Rgb(kAlbedo)));
  test::add(scene, scene::rectangle({-8, 0, -2}, {16, 0, 0}, {0, 8, 0}), mirror());
  return scene;
}
Document restricted(Document d, const char* paths) {
  d.method.paths = paths;
  return d;
}
Document seen_from_above(scene::Scene scene) {
  Document d = test::document(std::move(scene), look_at({0, 4, 0}, {0, 0, 0}, {0, 0, -1}, 0.3f), 8, 8);
  d.filter = film::FilterKind::box;
  return restricted(with_integrator(d, "path-manifold"), "EDSL");
}

// A mirror shows a light at the mirrored place, so the radiance of the floor is kAlbedo / pi I cos / d^2. Rays towards the
// light also meet the mirror, so walks nearly always arrive. What remains is the mean over the area of a pixel, 0.04 %.
TEST(ManifoldPathTracing, PointLightInAPlaneMirror) {
  auto scene = floor_and_mirror();
  constexpr float kIntensity = 10;
  test::add_point_light(scene, {0.5f, 1.5f, -1}, kIntensity);
  const Vec3 image(0.5f, 1.5f, -3);
  const Document d = seen_from_above(std::move(scene));
  const auto film = test::rendered(d, 256);
  const CameraRays rays(d.camera, d.width, d.height);
  for (int y = 0; y < d.height; ++y)
    for (int x = 0; x < d.width; ++x) {
      const Ray ray = rays.ray(Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f), Vec2(0), 0);
      const Vec3 at = ray.origin - ray.direction * (ray.origin.y / ray.direction.y);
      const Vec3 to_image = image - at;
      const double squared = length_squared(to_image);
      const double expected = kAlbedo / kPi * kIntensity * to_image.y / (squared * std::sqrt(squared));
      EXPECT_NEAR(film.mean(x, y).g / expected, 1, 1e-3) << x << ' ' << y;
    }
}

// Rays towards the light do not meet the mirror, so only walks from random starts can arrive. The mean is compared with 4.5
// times its standard error: a false alarm has a probability of 7e-6.
TEST(ManifoldPathTracing, DirectionalLightInAPlaneMirror) {
  auto scene = floor_and_mirror();
  Light light = make_light("directional");
  light.set("intensity", 3.0);
  scene::Transform place;
  const Vec3 direction = glm::normalize(Vec3(0.1f, -1, -1));
  place.matrix = look_at(Vec3(0), direction, {0, 1, 0}, 1).to_world;
  test::add(scene, light, place);
  const test::Mean mean = test::mean_of(test::rendered(seen_from_above(std::move(scene)), 256));
  const double expected = kAlbedo / kPi * 3.0 * -direction.y;
  EXPECT_NEAR(mean.value, expected, 4.5 * mean.standard_error);
  EXPECT_LT(mean.standard_error, 0.03 * expected);
}

// Chains are not sampled beside an environment that has nearly all of the power.
TEST(ManifoldPathTracing, DeclaresNoChainsThatItDoesNotSample) {
  const auto finds_chains = [](float radiance) {
    auto scene = floor_and_mirror();
    test::add_point_light(scene, {0.5f, 1.5f, -1}, 10);
    scene.environment.tint = Rgb(radiance);
    const Document d = seen_from_above(std::move(scene));
    const auto chains = transport::PathExpression::parse_paths("EDSL");
    const auto found = advisor::declared_paths(d, *scene::compile(d.scene, d.camera, nullptr));
    return advisor::without(chains->automaton(), found.point_paths).empty();
  };
  EXPECT_TRUE(finds_chains(0));
  EXPECT_FALSE(finds_chains(100));
}

// t-tests with a false-alarm rate of 1 % each. Light tracing finds lights without extent behind glass, too.
TEST(ManifoldPathTracing, AgreesWithLightTracingOnPointLightsBehindGlass) {
  for (const char* light : {"point", "directional"}) {
    const Document d = restricted(test::balls_under_light(light), "ED[S[S[S[S]]]]L");
    test::expect_same_mean(with_integrator(d, "light"), 1024, with_integrator(d, "path-manifold"), 256, light, 2);
  }
}

TEST(ManifoldPathTracing, AgreesWithBidirectionalPathTracing) {
  Document d = *render::new_document("caustic-pool");
  d.width = d.height = test::kSize;
  test::expect_same_mean(with_integrator(d, "bdpt"), 512, with_integrator(d, "path-manifold"), 128, "caustic-pool", 1);
}

// The variance of pixels, from the difference of two renders of the caustic that water throws onto the floor.
TEST(ManifoldPathTracing, FindsCausticsThroughWater) {
  const auto variance = [](const char* integrator) {
    Document d = *render::new_document("caustic-pool");
    d.width = d.height = 32;
    d = restricted(with_integrator(d, integrator), "ES*DS+L");
    Document other = d;
    other.seed = d.seed + 1;
    const auto a = test::rendered(d, 32), b = test::rendered(other, 32);
    double sum = 0;
    for (int y = 0; y < d.height; ++y)
      for (int x = 0; x < d.width; ++x) {
        sum += sqr(a.mean(x, y).g - b.mean(x, y).g);
      }
    return sum;
  };
  EXPECT_LT(variance("path-manifold"), 0.1 * variance("path"));
}

// The estimate of the weight over P, summed over the distributions of both numbers of walks, is the expected weight over P;
// BSDF samples have the rest of the expected weight by definition.
TEST(ManifoldPathTracing, WeightsOfWalksHaveNoBias) {
  constexpr int kCertain = 31;
  for (const float ratio : {8.0f, 60.0f, 2000.0f})  // of the densities
    for (const double p : {0.5, 0.1, 0.02}) {
      const integrator::manifold::WalkWeights weights(ratio, 1);
      ASSERT_FALSE(weights.none() || weights.all());
      double expected = 0, estimate = 0;
      for (int m = 1; m <= weights.longest_search(); ++m) {
        const double found = p * std::pow(1 - p, m - 1);
        expected += found * weights.after(m) / p;
        for (int n = 1; n < 2000; ++n)
          estimate += found * p * std::pow(1 - p, n - 1) * weights.over_probability(m, static_cast<float>(n), kCertain);
      }
      EXPECT_NEAR(estimate / expected, 1, 1e-5) << ratio << ' ' << p;
    }
}

TEST(ManifoldPathTracing, ThreadsDoNotMatter) {
  Document d = with_integrator(*render::new_document("cornell-spheres"), "path-manifold");
  d.width = d.height = 48;
  const auto one = test::rendered(d, 8, 1);
  for (const int threads : {2, 7}) test::expect_same_bits(one, test::rendered(d, 8, threads), "path-manifold");
}

}  // namespace
}  // namespace etendue::manifold_test
