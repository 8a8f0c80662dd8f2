// Guided path tracing: what it learns reduces the variance, a resumed render continues to the same bits, and images do
// not depend on the number of threads. That it is unbiased follows from the tests over all integrators (Pairwise,
// Furnace, GoldenSphere), and after many iterations from the comparison below.
#include <gtest/gtest.h>

#include "support/independent_estimates.h"
#include "support/integrator_scenes.h"
#include "support/resume.h"

namespace etendue {
namespace {

using render::Document;
using test::with;
using test::with_integrator;

Document builtin(const char* name, int size) {
  Document d = *render::new_document(name);
  d.width = d.height = size;
  return d;
}

// t-tests with a false-alarm rate of 1 %. The guide of the last samples has been learned in six iterations.
TEST(GuidedPathTracing, AgreesWithPathTracingAfterManyIterations) {
  for (const char* scene : {"cornell", "glossy-plates"}) {
    const Document d = builtin(scene, 24);
    test::expect_same_mean(with_integrator(d, "path"), 256, with_integrator(d, "path-guided"), 256, scene, 2);
  }
}

// The mean squared difference of two renders is twice the variance. Paths find the light of the next room through a
// narrow gap.
TEST(GuidedPathTracing, LearnsWhereLightComesFrom) {
  const auto variance = [](const char* integrator) {
    Document d = with(with_integrator(builtin("door-ajar", 48), integrator), "roulette-start", "64");
    d = with(with(d, "max-depth", "6"), "film.paths", "E(D|G)*L");
    Document other = d;
    other.seed = d.seed + 1;
    const auto a = test::rendered(d, 126), b = test::rendered(other, 126);
    double sum = 0, mean = 0;
    for (int y = 0; y < d.height; ++y)
      for (int x = 0; x < d.width; ++x) {
        const double p = std::min(double{a.mean(x, y).g}, 10.0), q = std::min(double{b.mean(x, y).g}, 10.0);
        sum += sqr(p - q);
        mean += p + q;
      }
    return sum / sqr(mean);
  };
  EXPECT_LT(variance("path-guided"), 0.7 * variance("path"));
}

TEST(GuidedPathTracing, ResumesToTheSameBits) {
  test::expect_same_bits_after_resume(with_integrator(builtin("cornell-spheres", 40), "path-guided"), "path-guided");
}

TEST(GuidedPathTracing, ThreadsDoNotMatter) {
  const Document d = with_integrator(builtin("glossy-plates", 70), "path-guided");
  const auto one = test::rendered(d, 15, 1);
  for (const int threads : {2, 7}) test::expect_same_bits(one, test::rendered(d, 15, threads), "path-guided");
}

}  // namespace
}  // namespace etendue
