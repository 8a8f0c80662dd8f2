// Scenes with closed-form radiance: the furnace [Lang, sec. 8.2], the emitting sphere [Lang, sec. 5.1.1, corrected],
// and the white furnace of lossless glass.
#include <gtest/gtest.h>

#include <cmath>

#include "integrator/integrator.h"
#include "render/incompatibility.h"
#include "support/scenes.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::furnace_test {
namespace {

using test::Mean;

// Unbiased integrators that sample every path of lights with area and that are compatible with the document.
std::vector<std::string> unbiased_integrators(const render::Document& document) {
  const auto scene = scene::compile(document.scene, document.camera, nullptr);
  const auto& all = transport::PathExpression::without_volumes().automaton();
  std::vector<std::string> names;
  render::Document d = document;
  for (const auto& info : integrator::integrator_infos()) {
    d.method.integrator = info.name;
    if (info.bias == integrator::Bias::unbiased && render::incompatibility(d, *scene).empty() &&
        transport::Automaton::difference(all, transport::PathExpression::parse_paths(info.paths)->automaton())->empty())
      names.push_back(info.name);
  }
  return names;
}

// Bound of the relative standard error of a mean in these tests, so that a noisier estimator does not pass more easily.
double largest_error(const std::string& method) {
  const bool per_pixel = integrator::find_integrator(method)->accumulation == integrator::Accumulation::per_pixel;
  return per_pixel ? 1.5e-3 : 0.01;
}

// Closed, Lambertian, emission one: L = 1 / (1 - albedo). Russian roulette starts where less than 1e-4 of the light is
// left, with almost no variance for integrators that sample each pixel, so their mean is accurate to 0.1 %. Light paths
// choose their pixels and have more variance.
void expect_a_furnace(float albedo, int size) {
  const int start = static_cast<int>(std::ceil(std::log(5e-5f) / std::log(albedo)));
  const auto place =
      test::document(test::furnace(albedo), look_at({0.3f, 0.1f, -0.2f}, {0, 0, 1}, {0, 1, 0}, 1), size, size);
  for (const auto& method : unbiased_integrators(place))
    for (const auto& sampler : sampler_infos()) {
      auto d = place;
      d.method.integrator = method;
      d.method.sampler = sampler.name;
      d = *render::with_text(d, "roulette-start", std::to_string(start));
      // Paths are long here, so trees have one branch. The tests below use the default number.
      if (const auto smaller = render::with_text(d, "branches-1", "1")) d = *smaller;
      const Mean mean = test::mean_of(test::rendered(d, 32));
      const double expected = 1 / (1 - albedo);
      EXPECT_NEAR(mean.value, expected, std::max(1e-3 * expected, 4 * mean.standard_error))
          << method << ' ' << sampler.name << " +- " << mean.standard_error;
      EXPECT_LT(mean.standard_error, largest_error(method) * expected) << method << ' ' << sampler.name;
    }
}
TEST(Furnace, UnbiasedIntegratorsWithEverySampler) { expect_a_furnace(0.5f, 20); }
// A quarter of the light arrives on paths with more vertices than samplers have dimensions. With a higher albedo, rare
// survivors of roulette would carry as much light as the tolerance.
TEST(Furnace, UnbiasedIntegratorsWithEverySamplerOnLongPaths) { expect_a_furnace(0.85f, 12); }

// Roulette changes the variance, not the mean: a z-test over pixels with a false-alarm rate of 1 % for all cases
// together.
TEST(Furnace, RouletteIsUnbiased) {
  constexpr double kZ = 3.89;  // Sidak: at most 100 comparisons, 3 for each integrator
  const auto place = test::document(test::furnace(0.7f), look_at({0.3f, 0.1f, -0.2f}, {0, 0, 1}, {0, 1, 0}, 1), 64, 64);
  for (const auto& method : unbiased_integrators(place))
    for (const int start : {1, 2, 8}) {
      auto d = place;
      d.method.integrator = method;
      d.method.sampler = "random";
      d = *render::with_text(d, "roulette-start", std::to_string(start));
      const Mean mean = test::mean_of(test::rendered(d, 64));
      EXPECT_LT(std::abs(mean.value - 1 / (1 - 0.7)), kZ * mean.standard_error) << method << ' ' << start;
      EXPECT_LT(mean.standard_error, 0.01 / (1 - 0.7)) << method << ' ' << start;
    }
}

// The partial sum of the Neumann series: (1 - albedo^k) / (1 - albedo) for depth k.
TEST(Furnace, DepthLimitGivesThePartialSum) {
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

// A diffuse sphere of emission C: L = C / (1 - rho), independent of its radius [Lang, eq. 5.37-5.41, corrected].
TEST(EmittingSphere, RadianceSeenFromInside) {
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

// A lossless sphere in a constant environment is invisible: every pixel has the radiance of the environment.
TEST(WhiteFurnace, SmoothGlassIsInvisible) {
  scene::Scene scene;
  Material glass;
  glass.metallic = 0;
  glass.roughness = 0;
  glass.transmission = 1;
  glass.thickness = 1;
  test::add(scene, test::sphere(1, 24, false), glass);
  scene.environment.tint = Rgb(1);
  const auto place = test::document(scene, look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.6f), 32, 32);
  for (const auto& method : unbiased_integrators(place)) {
    auto d = place;
    d.method.integrator = method;
    const Mean mean = test::mean_of(test::rendered(d, 128));
    EXPECT_NEAR(mean.value, 1, std::max(2e-3, 4 * mean.standard_error)) << method;
    EXPECT_LT(mean.standard_error, 0.01) << method;
  }
}

}  // namespace
}  // namespace etendue::furnace_test
