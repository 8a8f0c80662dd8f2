// Guided path tracing and guided bidirectional path tracing: what they learn reduces the variance, a resumed render continues to the same bits, and images do
// not depend on the number of threads. That it is unbiased follows from the tests over all integrators (Pairwise, Furnace),
// from the closed form of the integrating sphere (IntegratingSphere.GuidedPathTracing), and after many iterations from
// the comparison below.
#include <gtest/gtest.h>

#include "support/independent_estimates.h"
#include "support/integrator_scenes.h"
#include "support/resume.h"

namespace etendue::guided_test {
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

TEST(GuidedPathTracing, AgreesWithPathTracingWhenGuidedByProducts) {
  const Document d = builtin("glossy-plates", 24);
  const Document guided = with(with_integrator(d, "path-guided"), "product", "on");
  test::expect_same_mean(with_integrator(d, "path"), 256, guided, 256, "glossy-plates", 1);
}

// The MIS weights of all techniques depend on the guide. In the last scene most directions are guided.
TEST(GuidedBdpt, AgreesWithBdptAfterManyIterations) {
  for (const char* scene : {"cornell-spheres", "glossy-plates", "spot-indirect"}) {
    const Document d = builtin(scene, 24);
    test::expect_same_mean(with_integrator(d, "bdpt"), 256, with_integrator(d, "bdpt-guided"), 254, scene, 3);
  }
}

// The relative variance of pixels, from the difference of two renders. One bright patch lights the room, which paths find
// by chance unless they have learned where it is.
TEST(GuidedPathTracing, LearnsWhereLightComesFrom) {
  const auto variance = [](const char* integrator) {
    const Document d = with_integrator(builtin("spot-indirect", 48), integrator);
    Document other = d;
    other.seed = d.seed + 1;
    const auto a = test::rendered(d, 254), b = test::rendered(other, 254);
    double sum = 0;
    for (int y = 0; y < d.height; ++y)
      for (int x = 0; x < d.width; ++x) {
        const double p = a.mean(x, y).g, q = b.mean(x, y).g;
        sum += sqr((p - q) / (p + q + 1e-3));
      }
    return sum;
  };
  EXPECT_LT(variance("path-guided"), 0.5 * variance("path"));
}

class GuidedIntegrators : public testing::TestWithParam<const char*> {};

TEST_P(GuidedIntegrators, ResumeToTheSameBits) {
  test::expect_same_bits_after_resume(with_integrator(builtin("cornell-spheres", 40), GetParam()), GetParam());
}

TEST_P(GuidedIntegrators, DoNotDependOnThreads) {
  const Document d = with_integrator(builtin("glossy-plates", 70), GetParam());
  const auto one = test::rendered(d, 15, 1);
  for (const int threads : {2, 7}) test::expect_same_bits(one, test::rendered(d, 15, threads), GetParam());
}

INSTANTIATE_TEST_SUITE_P(All, GuidedIntegrators, testing::Values("path-guided", "bdpt-guided"),
                         [](const auto& tested) { return std::string(tested.param).substr(0, 4); });

}  // namespace
}  // namespace etendue::guided_test
