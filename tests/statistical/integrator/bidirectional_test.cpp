// Integrators with light subpaths against path tracing, where pairwise_test.cpp does not compare them: delta lights,
// path classes, subsets of techniques. t-tests over blocks of pixels with a false-alarm rate of 1 % per test.
#include <gtest/gtest.h>

#include "integrator/bdpt/techniques.h"
#include "scene/builtin/many_lights.h"
#include "support/integrator_scenes.h"

namespace etendue::bidirectional_test {
namespace {

using render::Document;

using test::balls_under_area_light;
using test::balls_under_light;
using test::balls_under_sky;
using test::expect_same_mean;
using test::view_from_above;
using test::with;
using test::with_integrator;
using test::with_lens;
using test::without_specular_first_hit;

Document cornell() { return test::cornell(test::kSize); }

// Light samples choose by the light tree.
Document with_many_lights() {
  Document d = *render::new_document("many-lights");
  d.scene = std::make_shared<const scene::Scene>(scene::hall_of_lights(24));
  d.width = d.height = test::kSize;
  return d;
}

// Camera paths cannot sample light of a point light that reaches a diffuse surface through glass. Light tracing and
// bidirectional path tracing are compared with each other on these paths.
TEST(Bidirectional, PunctualLights) {
  for (const char* type : {"point", "spot", "directional", "photometric", "projector"}) {
    const Document d = balls_under_light(type), connected = with(d, "film.paths", "E.*(D|G)L");
    const std::string name = std::string(type) + " light";
    expect_same_mean(with_integrator(connected, "path"), 128, with_integrator(connected, "bdpt"), 64, name, 6);
    const Document lit = without_specular_first_hit(d);
    expect_same_mean(with_integrator(lit, "light"), 384, with_integrator(lit, "bdpt"), 128,
                     name + ", caustics included", 6);
  }
}

// The disk of the sun is an end of light paths as well as of camera paths.
// Path tracing finds the caustic of the sun only by chance, in so few samples that they do not show its variance.
TEST(Bidirectional, SunOfTheSky) {
  const Document d = without_specular_first_hit(test::balls_under_sun());
  const Document direct = test::with(d, "film.paths", "E(D|G)+L");
  expect_same_mean(with_integrator(direct, "path"), 512, with_integrator(direct, "bdpt"), 512, "sun", 6);
  expect_same_mean(with_integrator(d, "light"), 512, with_integrator(d, "bdpt"), 128, "sun, light paths", 6);
}

// A portal over one of two openings of a room changes no mean, and reduces the variance.
TEST(Bidirectional, PortalsAreUnbiased) {
  const Document plain = test::room_with_two_windows(false), guided = test::room_with_two_windows(true);
  expect_same_mean(with_integrator(plain, "path"), 512, with_integrator(guided, "path"), 256, "path", 4);
  expect_same_mean(with_integrator(plain, "distribution"), 128, with_integrator(guided, "distribution"), 64,
                   "distribution", 4);
  expect_same_mean(with_integrator(guided, "bdpt"), 256, with_integrator(guided, "path"), 256, "bdpt", 4);
  const auto error = [](const Document& d) {
    return test::mean_of(test::rendered(with_integrator(d, "path"), 64)).standard_error;
  };
  EXPECT_LT(error(guided), error(plain));
}

// Light subpaths leave a two-sided light on both sides.
TEST(Bidirectional, TwoSidedLightInView) {
  scene::Scene scene;
  test::add(scene, test::quad(1), test::diffuse(Rgb(0.5f), Rgb(1)));
  const Document d = view_from_above(std::move(scene));
  const auto expected = test::replicated(with_integrator(d, "path"), 128);
  for (const char* method : {"light", "bdpt", "pssmlt"})
    test::expect_agreement(expected, test::replicated(with_integrator(d, method), 128), method, 3);
}

TEST(Bidirectional, PathClassesAgree) {
  const Document d = balls_under_area_light();
  const char* classes[] = {"EL", "EDL", "E(D|G)S+L|E.*DS+DL", "EGD.*L", "ED.*GL|ES.*L", "E.G.*L"};
  for (const char* paths : classes)
    expect_same_mean(with_integrator(with(d, "film.paths", paths), "path"), 512,
                     with_integrator(with(d, "film.paths", paths), "bdpt"), 128, paths, 6);
}

TEST(Bidirectional, EverySubsetOfTechniquesIsUnbiased) {
  const Document d = cornell();
  const auto expected = test::replicated(with_integrator(d, "path"), 512);
  for (const char* without : {"0,*", "1,*", "*,1", "2,2 1,3", "2,* 3,* 4,*"})
    test::expect_agreement(expected, test::replicated(with(with_integrator(d, "bdpt"), "without", without), 64),
                           without, 5);
}

// The recursive evaluation of the MIS weights equals the direct sum of all terms [Lang, eq. 9.101-9.107, corrected].
TEST(Bidirectional, RecursiveWeightsEqualTheDirectSum) {
  for (const Document& place : {cornell(), with_lens(balls_under_area_light()), balls_under_sky(), with_many_lights()})
    for (const char* heuristic : {"balance", "power", "maximum"}) {
      const Document d = with(with_integrator(place, "bdpt"), "heuristic", heuristic);
      const auto quick = test::rendered(d, 8), slow = test::rendered(with(d, "without", "99,99"), 8);
      for (int y = 0; y < d.height; ++y)
        for (int x = 0; x < d.width; ++x)
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(quick.mean(x, y)[c], slow.mean(x, y)[c], 1e-4 * (quick.mean(x, y)[c] + 0.01)) << heuristic;
    }
}

// The contributions of the techniques sum to the image.
TEST(Bidirectional, TechniquesSumToTheImage) {
  const Document d = with(with_integrator(cornell(), "bdpt"), "max-depth", "3");
  const auto whole = test::rendered(d, 8);
  std::vector<double> sum(static_cast<size_t>(d.width * d.height), 0);
  for (int edges = 1; edges <= 3; ++edges)
    for (int s = 0; s <= edges + 1; ++s) {
      const auto part = test::rendered(with(d, "only", std::to_string(s) + "," + std::to_string(edges + 1 - s)), 8);
      for (int y = 0; y < d.height; ++y)
        for (int x = 0; x < d.width; ++x) sum[static_cast<size_t>(y * d.width + x)] += double{part.mean(x, y).g};
    }
  for (int y = 0; y < d.height; ++y)
    for (int x = 0; x < d.width; ++x)
      EXPECT_NEAR(sum[static_cast<size_t>(y * d.width + x)], whole.mean(x, y).g, 1e-4) << x << ' ' << y;
}

TEST(Bidirectional, BitIdenticalForAnyNumberOfThreads) {
  for (const char* method : {"bdpt", "light", "light-pure"}) {
    Document d = with_lens(cornell());
    d.width = 70;
    d.height = 50;
    const auto one = test::rendered(with_integrator(d, method), 4, 1);
    for (const int threads : {2, 7}) {
      const auto many = test::rendered(with_integrator(d, method), 4, threads);
      for (size_t i = 0; i < one.pixels().size(); ++i)
        ASSERT_EQ(one.pixels()[i].sum, many.pixels()[i].sum) << method << ' ' << threads;
    }
  }
}

TEST(Techniques, ExpressionsAreParsed) {
  const auto set = integrator::Techniques::parse(" 0,* 2,3 ");
  ASSERT_TRUE(set);
  EXPECT_TRUE(set->contains(0, 5) && set->contains(2, 3));
  EXPECT_FALSE(set->contains(2, 2) || set->contains(1, 3));
  EXPECT_TRUE(integrator::Techniques::parse("")->empty());
  for (const char* wrong : {"2", "a,b", "1,2,3", "-1,2", "1;2"})
    EXPECT_FALSE(integrator::Techniques::parse(wrong)) << wrong;
}

}  // namespace
}  // namespace etendue::bidirectional_test
