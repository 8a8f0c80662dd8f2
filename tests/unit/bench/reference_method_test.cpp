// The choice of the integrator that renders a reference.
#include "bench/reference_method.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bench/reference.h"
#include "support/scenes.h"

namespace etendue::bench {
namespace {

TEST(ReferenceMethod, TheSmallestCostIsChosen) {
  const std::vector<ReferencePilot> pilots{{"path", 3, 1, 0.1}, {"bdpt", 2, 1.1, 0.1}, {"light", 5, 0.9, 0.1}};
  ASSERT_NE(most_efficient(pilots), nullptr);
  EXPECT_EQ(most_efficient(pilots)->name, "bdpt");
}

TEST(ReferenceMethod, ADarkImageIsNotChosen) {
  const std::vector<ReferencePilot> pilots{{"path", 1, 0.5, 0.05}, {"bdpt", 2, 1, 0.05}};
  EXPECT_EQ(most_efficient(pilots)->name, "bdpt");
  const std::vector<ReferencePilot> noisy{{"path", 1, 0.5, 0.2}, {"bdpt", 2, 1, 0.2}};
  EXPECT_EQ(most_efficient(noisy)->name, "path");
}

TEST(ReferenceMethod, UnknownErrorsAreNotChosen) {
  EXPECT_EQ(most_efficient({}), nullptr);
  const std::vector<ReferencePilot> unknown{{"path", INFINITY, 0, 0}};
  EXPECT_EQ(most_efficient(unknown), nullptr);
}

TEST(ReferenceMethod, BidirectionalPathTracingIsACandidateWhereItFindsTheSamePaths) {
  render::Document d = test::cornell(8);
  EXPECT_EQ(reference_candidates(d, {}), (std::vector<std::string>{"path", "bdpt"}));
  scene::Scene with_point = *d.scene;
  test::add_point_light(with_point, {0, 0, 0}, 1);
  d.scene = std::make_shared<const scene::Scene>(with_point);
  EXPECT_EQ(reference_candidates(d, {}), std::vector<std::string>{"path"}) << "it finds caustics of point lights";
}

TEST(ReferenceMethod, TheLimitOnThePathDepthIsKept) {
  const render::Document d = *render::with_text(test::cornell(8), "path.max-depth", "3");
  const render::Document reference = ReferenceStore(d, {}, "bdpt").document();
  EXPECT_EQ(reference.method.integrator, "bdpt");
  EXPECT_EQ(to_string(*render::get(reference, "bdpt.max-depth")), "3");
}

}  // namespace
}  // namespace etendue::bench
