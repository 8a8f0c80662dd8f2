// Preprocessing phases of integrators, as reported by the status of a session.
#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <thread>

#include "integrator/integrator.h"
#include "render/session.h"
#include "support/scenes.h"

namespace etendue {
namespace {

// Enough photons for some seconds of preprocessing.
render::Document slow_to_begin() {
  auto d = test::cornell(16);
  d.method.integrator = "photonmap";
  return *render::with_text(d, "photonmap.photons", "20000000");
}

// Expects the status to report an unfinished phase.
void expect_unfinished_phase(render::Session& session) {
  std::set<double> seen;
  std::string phase;
  while (seen.size() < 3 && !session.status().finished) {
    const auto status = session.status();
    if (status.phase_progress > 0) {
      seen.insert(status.phase_progress);
      phase = status.phase;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_EQ(seen.size(), 3u);
  EXPECT_NE(phase.find("photons"), std::string::npos) << phase;
}

TEST(Phases, LongPhasesAreReportedAndEndWithAnEdit) {
  for (const bool interactive : {false, true}) {
    render::Session session({2, interactive});
    auto d = slow_to_begin();
    d.limits.samples = 1;
    session.submit(d);
    expect_unfinished_phase(session);
    d.method.integrator = "path";
    session.submit(d);
    session.finish();
    EXPECT_EQ(session.status().samples, 1u);
    EXPECT_EQ(session.status().phase, "done");
  }
}

// The status reports only phases that have lasted for some time, so that labels do not flicker.
TEST(Phases, IntegratorsWithoutPhasesReportNone) {
  render::Session session({2});
  auto d = test::cornell(32);
  d.limits.samples = 64;
  session.submit(d);
  while (!session.status().finished) EXPECT_EQ(session.status().phase_progress, 0);
}

}  // namespace
}  // namespace etendue
