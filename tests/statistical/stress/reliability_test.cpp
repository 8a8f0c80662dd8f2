// Reliability verdicts of full renderings, with error rates. Seeds are fixed, so the counts are reproducible.
#include <gtest/gtest.h>

#include "render/session.h"
#include "stress/cases/light_that_touches_a_wall.h"
#include "support/scenes.h"

namespace etendue::stress {
namespace {

using render::Verdict;

constexpr int kRuns = 100;

// The number of kRuns small renderings with this verdict.
int count(render::Document d, const std::string& method, uint32_t samples, Verdict verdict) {
  d = TestContext::with_method(d, method);
  d.limits = {samples, 0, 0};
  int found = 0;
  render::Session session({.threads = 1});
  for (int i = 0; i < kRuns; ++i) {
    d.seed = static_cast<uint64_t>(i) + 1;
    session.submit(d);
    session.finish();
    found += session.status().reliability->verdict == verdict ? 1 : 0;
  }
  return found;
}

// Tail index k = 1: missed in at most 6 % of the runs at 64 samples per pixel, and in 20 % at 16.
TEST(Reliability, InfiniteVarianceIsCalledUnreliable) {
  const auto d = wall_on_a_light(TestContext({}), 12);
  for (const char* method : {"raycast:lights=one", "raycast:lights=one:sampler=random"}) {
    EXPECT_GE(count(d, method, 64, Verdict::unreliable), 94) << method;
    EXPECT_GE(count(d, method, 16, Verdict::unreliable), 80) << method;
  }
}

// A constant environment with MIS, and scenes with bounded estimators: no false alarm in 600 runs.
TEST(Reliability, BoundedEstimatorsAreReliable) {
  const auto inside = look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1);
  for (const uint32_t samples : {16U, 64U}) {
    EXPECT_EQ(count(wall_on_a_light(TestContext({}), 1), "path", samples, Verdict::healthy), kRuns) << samples;
    EXPECT_EQ(count(test::document(scene::furnace(0.5f), inside, 32, 32), "path", samples, Verdict::healthy), kRuns);
    EXPECT_EQ(count(test::cornell(24), "path", samples, Verdict::healthy), kRuns) << samples;
  }
}

TEST(Reliability, TooFewSamplesGiveNoVerdict) {
  EXPECT_EQ(count(test::cornell(16), "path", 9, Verdict::unknown), kRuns);
  EXPECT_EQ(count(test::cornell(16), "path", 10, Verdict::unknown), 0);
}

}  // namespace
}  // namespace etendue::stress
