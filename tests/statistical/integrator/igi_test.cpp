// Instant global illumination [Lang, eq. 9.148-9.158, corrected] against closed forms and path tracing.
#include <gtest/gtest.h>

#include "stress/lit_wall.h"
#include "support/independent_estimates.h"

namespace etendue::igi_test {
namespace {

using test::expect_agreement;
using test::replicated;

render::Document igi(render::Document d, const std::vector<std::pair<std::string, std::string>>& settings) {
  d.method.integrator = "igi";
  for (const auto& [name, value] : settings) d = *render::with_text(d, "igi." + name, value);
  return d;
}

render::Document by_path(render::Document d) {
  d.method.integrator = "path";
  return d;
}

render::Document room() { return test::cornell(test::kSize); }

// On diffuse surfaces the approximation of the BSDF at a virtual light by a Lambertian is exact.
TEST(InstantGlobalIllumination, EqualsPathTracingInDiffuseScenes) {
  const auto reference = replicated(by_path(room()), 256);
  expect_agreement(replicated(igi(room(), {{"light-paths", "16"}}), 16, 3000), reference, "lambertian", 4);
  expect_agreement(replicated(igi(room(), {{"light-paths", "16"}, {"full-bsdf", "on"}}), 16, 4000), reference, "full",
                   4);
  expect_agreement(replicated(igi(room(), {{"light-paths", "18"}, {"interleave", "3"}}), 32, 5000), reference,
                   "interleaved", 4);
  expect_agreement(replicated(igi(room(), {{"light-paths", "16"}, {"bound", "0.5"}}), 16, 6000), reference,
                   "compensation of the bound", 4);
}

// A glazed floor and a metal wall under an area light: both ends of a connection have two lobes.
TEST(InstantGlobalIllumination, FullBsdfEqualsPathTracingOfItsPathClasses) {
  scene::Scene scene;
  Material glazed, metal;
  glazed.metallic = 0;
  glazed.roughness = 0.6f;
  glazed.ior = 2;
  glazed.base_color = Rgb(0.4f);
  metal.metallic = 1;
  metal.roughness = 0.6f;
  metal.base_color = {0.9f, 0.7f, 0.4f};
  test::add(scene, test::quad(2), glazed);
  Mat4 upright(1);
  upright[1] = Vec4(0, 0, 1, 0);
  upright[2] = Vec4(0, -1, 0, 0);
  upright[3] = Vec4(0, 1, -1.5f, 1);
  test::add(scene, test::quad(1.5f), metal, upright);
  Mat4 above(1);
  above[1][1] = -1;
  above[2][2] = -1;
  above[3] = Vec4(0, 3, 0, 1);
  test::add(scene, test::quad(0.7f), test::diffuse(Rgb(0), Rgb(5)), above);
  const auto d = test::document(scene, look_at({0, 2, 4}, {0, 0.5f, 0}, {0, 1, 0}, 0.5f), test::kSize, test::kSize);
  auto reference = by_path(d);
  for (const char* paths : {"ES*[(D|G)[(D|G).*]]L", "EDGL", "EGDL"}) {
    reference.method.paths = paths;
    auto virtual_lights = igi(d, {{"light-paths", "32"}, {"full-bsdf", "on"}, {"bound", "0.5"}});
    virtual_lights.method.paths = paths;
    expect_agreement(replicated(virtual_lights, 32, 3000), replicated(reference, 256), paths, 3);
  }
}

// Each virtual light y_j contributes exactly a rho^(j+1) in the integrating sphere. For a fixed depth, the sum of two
// terms has no noise except from the tessellation.
TEST(InstantGlobalIllumination, IntegratingSphere) {
  constexpr double kShare = 0.05, kAlbedo = 0.5;
  auto d = test::integrating_sphere(kShare, kAlbedo, scene::Cap::reflecting, 16);
  // Mean of the full sum. Paths end at random, so that the number of lights varies.
  const auto whole = test::mean_of(test::rendered(igi(d, {{"light-paths", "400"}}), 16));
  EXPECT_NEAR(whole.value, kAlbedo * kShare / (1 - kAlbedo), 0.02 * kShare);
  // The contribution of y_1 alone: every light path has such a vertex, with the same contribution everywhere.
  const auto first = test::mean_of(test::rendered(igi(d, {{"light-paths", "50"}, {"max-depth", "3"}}), 2));
  EXPECT_NEAR(first.value, kShare * (kAlbedo + kAlbedo * kAlbedo), 1e-3 * kShare);
}

// In a sphere of radius one, G = 1/4 everywhere. A bound g below 1/4 scales the indirect light by 4 g.
TEST(InstantGlobalIllumination, BoundScalesTheIntegratingSphere) {
  constexpr double kShare = 0.05, kAlbedo = 0.5;
  auto d = test::integrating_sphere(kShare, kAlbedo, scene::Cap::reflecting, 16);
  for (const double bound : {0.2, 0.1, 0.01}) {
    const auto cut =
        igi(d, {{"light-paths", "50"}, {"max-depth", "3"}, {"compensate", "off"}, {"bound", std::to_string(bound)}});
    const double expected = kShare * (kAlbedo + kAlbedo * kAlbedo * 4 * bound);
    EXPECT_NEAR(test::mean_of(test::rendered(cut, 2)).value, expected, 2e-3 * expected) << bound;
  }
}

// Weak singularity: a floor at distance d from the centre of a unit wall under uniform parallel light. The estimate of
// one virtual light on the wall has a relative standard deviation that grows as 1 / d. A light path places a light on
// the wall with probability p, the share of the parallel light that hits it; the floor receives no other light. For n
// paths the relative variance is ((1 + deviation^2) / p - 1) / n. Tolerances are 4.5 standard errors; the tabulated
// deviations have two digits.
TEST(InstantGlobalIllumination, DeviationInACorner) {
  struct Row {
    float distance;
    double form_factor, deviation;
  };
  for (const Row& row : {Row{0.5f, 0.19014, 0.48}, Row{0.1f, 0.42254, 2.53}}) {
    EXPECT_NEAR(stress::form_factor_of_lit_wall(double{row.distance}), row.form_factor, 5e-6);
    auto d = test::document(stress::lit_wall(test::diffuse(Rgb(0.8f)), row.distance),
                            stress::camera_of_lit_wall(row.distance), 2, 2);
    d.method.sampler = "random";
    d = igi(d, {{"light-paths", "64"}, {"max-depth", "3"}});
    // The sampled disk is that of the bounding sphere of the scene, from the edges of the wall to the far end of the
    // floor.
    const double depth = 1.02 * double{row.distance}, radius2 = (2 + depth * depth) / 4;
    const double chance = 1 / (double{kPi} * radius2);
    constexpr int kPictures = 4000;
    constexpr double kPaths = 2 * 64;
    double sum = 0, squares = 0, fourths = 0;
    const double expected = 0.5 / double{kPi} * 0.8 * row.form_factor;
    for (d.seed = 0; d.seed < kPictures; ++d.seed) {
      const double found = test::mean_of(test::rendered(d, 2, 1)).value / expected, square = sqr(found - 1);
      sum += found;
      squares += square;
      fourths += square * square;
    }
    const double variance = squares / kPictures, theory = ((1 + sqr(row.deviation)) / chance - 1) / kPaths;
    EXPECT_NEAR(sum / kPictures, 1, 4.5 * std::sqrt(variance / kPictures) + 1e-3) << row.distance;
    EXPECT_NEAR(variance, theory, 4.5 * std::sqrt((fourths / kPictures - sqr(variance)) / kPictures) + 0.01 * theory)
        << row.distance;
  }
}

TEST(InstantGlobalIllumination, FixedLightsKeepTheirError) {
  const auto two = [](const char* renew) {
    const auto d = igi(room(), {{"light-paths", "4"}, {"renew", renew}});
    auto other = d;
    other.seed = 5;
    return std::abs(test::mean_of(test::rendered(d, 64)).value - test::mean_of(test::rendered(other, 64)).value);
  };
  EXPECT_GT(two("off"), 2 * two("on"));
}

}  // namespace
}  // namespace etendue::igi_test
