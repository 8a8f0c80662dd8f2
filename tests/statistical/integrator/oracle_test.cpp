// Scenes whose radiance is known in closed form.                      digest 4-5: 3.1 d, 3.3 D; digest 8-10: O3
#include <gtest/gtest.h>

#include "integrator/integrator.h"
#include "render/incompatibility.h"
#include "support/scenes.h"
#include "transport/path_expression/path_expression.h"

namespace etendue {
namespace {

using test::Mean;

// Those that find every path of lights with an extent, and that nothing hinders in the document's picture.
std::vector<std::string> unbiased_integrators(const render::Document& document) {
  const auto scene = scene::compile(document.scene, document.camera, nullptr);
  const auto& all = transport::PathExpression::all().automaton();
  std::vector<std::string> names;
  render::Document d = document;
  for (const auto& info : integrator::integrator_infos()) {
    d.method.integrator = info.name;
    if (info.bias == integrator::Bias::unbiased && render::incompatibility(d, *scene).empty() &&
        transport::PathExpression::parse_paths(info.paths)->automaton() == all)
      names.push_back(info.name);
  }
  return names;
}

// Closed, Lambertian, emitting radiance one: L = 1 / (1 - albedo). Late roulette leaves next to no variance where
// pixels are sampled alone, so that the mean stands to 0.1 %; light paths choose their pixels, and leave some.
void expect_a_furnace(float albedo, int size) {
  const auto place =
      test::document(test::furnace(albedo), look_at({0.3f, 0.1f, -0.2f}, {0, 0, 1}, {0, 1, 0}, 1), size, size);
  for (const auto& method : unbiased_integrators(place))
    for (const auto& sampler : sampler_infos()) {
      auto d = place;
      d.method.integrator = method;
      d.method.sampler = sampler.name;
      d = *render::with_text(d, "roulette-start", "64");
      // Walks are long here: trees have one branch, as many as they like in the tests below.
      if (const auto smaller = render::with_text(d, "branches-1", "1")) d = *smaller;
      const Mean mean = test::mean_of(test::rendered(d, 32));
      const double expected = 1 / (1 - albedo);
      EXPECT_NEAR(mean.value, expected, std::max(1e-3 * expected, 4 * mean.standard_error))
          << method << ' ' << sampler.name << " +- " << mean.standard_error;
    }
}
TEST(Furnace, EveryUnbiasedMethodWithEverySampler) { expect_a_furnace(0.5f, 20); }
TEST(Furnace, EveryUnbiasedMethodWithEverySamplerOnLongWalks) { expect_a_furnace(0.9f, 12); }

// Roulette changes the noise, not the mean: a z-test over pixels at a false-alarm rate of 1 % for all cases together.
TEST(Furnace, RouletteIsUnbiased) {
  constexpr double kZ = 3.26;  // Sidak: 3 methods x 3 starts
  const auto place = test::document(test::furnace(0.7f), look_at({0.3f, 0.1f, -0.2f}, {0, 0, 1}, {0, 1, 0}, 1), 64, 64);
  for (const auto& method : unbiased_integrators(place))
    for (const int start : {1, 2, 8}) {
      auto d = place;
      d.method.integrator = method;
      d.method.sampler = "random";
      d = *render::with_text(d, "roulette-start", std::to_string(start));
      const Mean mean = test::mean_of(test::rendered(d, 64));
      EXPECT_LT(std::abs(mean.value - 1 / (1 - 0.7)), kZ * mean.standard_error) << method << ' ' << start;
    }
}

// The partial sum of depth k: (1 - albedo^k) / (1 - albedo).
TEST(Furnace, DepthLimitLosesWhatTheoryPredicts) {
  const auto place = test::document(test::furnace(0.5f), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1), 32, 32);
  for (const auto& method : unbiased_integrators(place))
    for (const int depth : {1, 2, 3, 5}) {
      auto d = place;
      d.method.integrator = method;
      d = *render::with_text(d, "max-depth", std::to_string(depth));
      const double expected = (1 - std::pow(0.5, depth)) / 0.5;
      EXPECT_NEAR(test::mean_of(test::rendered(d, 128)).value, expected, 2e-3 * expected)
          << method << " depth " << depth;
    }
}

// A diffuse sphere that emits C: L = C / (1 - rho), whatever its radius (erratum E37).
TEST(EmittingSphere, SeenFromInside) {
  for (const float radius : {1e-3f, 1.0f, 1e5f}) {
    scene::Scene scene;
    test::add(scene, test::sphere(radius, 32, true), test::diffuse(Rgb(0.5f), Rgb(1)));
    const auto place =
        test::document(scene, look_at(radius * Vec3(0.2f, 0.1f, 0), radius * Vec3(0, 0, 1), {0, 1, 0}, 1), 32, 32);
    for (const auto& method : unbiased_integrators(place)) {
      auto d = place;
      d.method.integrator = method;
      EXPECT_NEAR(test::mean_of(test::rendered(d, 128)).value, 2, 4e-3) << method << " radius " << radius;
    }
  }
}

// A constant environment around a sphere that loses nothing: every pixel is the environment.
TEST(WhiteFurnace, SmoothGlassDisappears) {
  scene::Scene scene;
  Material glass;
  glass.metallic = 0, glass.roughness = 0, glass.transmission = 1, glass.thickness = 1;
  test::add(scene, test::sphere(1, 24, false), glass);
  scene.environment.tint = Rgb(1);
  const auto place = test::document(scene, look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.6f), 32, 32);
  for (const auto& method : unbiased_integrators(place)) {
    auto d = place;
    d.method.integrator = method;
    const Mean mean = test::mean_of(test::rendered(d, 128));
    EXPECT_NEAR(mean.value, 1, std::max(2e-3, 4 * mean.standard_error)) << method;
  }
}

}  // namespace
}  // namespace etendue
