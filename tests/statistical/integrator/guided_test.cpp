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

// The MIS weights of all techniques contain the density of guided directions. If most directions are guided, a density
// that is missing in one technique makes the image too dark.
TEST(GuidedBdpt, AgreesWithBdptWhenMostDirectionsAreGuided) {
  const Document d = builtin("spot-indirect", 24);
  for (const char* heuristic : {"power", "maximum"}) {
    const Document guided = with(with(with_integrator(d, "bdpt-guided"), "fraction", "0.9"), "heuristic", heuristic);
    test::expect_same_mean(with_integrator(d, "bdpt"), 1024, guided, 510, heuristic, 2);
  }
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
