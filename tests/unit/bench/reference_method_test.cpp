// The choice of the integrator that renders a reference.
#include "bench/reference_method.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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

}  // namespace
}  // namespace etendue::bench
