// The Paths panel and the recommendation of a method.
#include "scripted.h"

namespace etendue::paths_test {
namespace {

json steps_of(std::initializer_list<json> steps) { return json::array_t(steps); }

class PathsPanel : public Viewer {
 protected:
  static json measured() { return joined(small(), steps_of({click("panel.paths"), wait_for("paths")})); }
  // small() makes three edits.
  static constexpr int kDepth = 3;
};

TEST_F(PathsPanel, SharesAddUpAndAClickRendersOneClass) {
  const auto steps = joined(measured(), steps_of({file_step("state", path("all.json")),
                                                  file_step("screenshot", path("panel.png")),
                                                  click("paths.row.1"),
                                                  {{"do", "wait"}, {"spp", 1}},
                                                  file_step("state", path("one.json")),
                                                  click("paths.row.1"),
                                                  file_step("state", path("again.json")),
                                                  click("paths.row.0"),
                                                  click("paths.all"),
                                                  file_step("state", path("button.json"))}));
  ASSERT_EQ(run(steps), 0);
  const auto all = state("all.json");
  EXPECT_TRUE(all["paths"]["fresh"]);
  EXPECT_FALSE(all["paths"]["running"]);
  double sum = 0;
  for (const auto& row : all["paths"]["rows"]) {
    sum += row["share"].get<double>();
    EXPECT_EQ(row["found"], "yes") << row;  // path tracing finds them all
  }
  EXPECT_NEAR(sum, 1, 1e-4);
  ASSERT_GE(all["paths"]["rows"].size(), 3u);
  EXPECT_EQ(all["undo_depth"], kDepth);

  const auto one = state("one.json");
  EXPECT_EQ(one["parameters"]["film.paths"], all["paths"]["rows"][1]["paths"]);
  EXPECT_EQ(one["undo_depth"], kDepth + 1);
  // The table still has all classes.
  EXPECT_EQ(one["paths"], all["paths"]);
  EXPECT_EQ(state("again.json")["parameters"]["film.paths"], "");
  EXPECT_EQ(state("button.json")["parameters"]["film.paths"], "");
  EXPECT_EQ(state("button.json")["undo_depth"], kDepth + 4);
}

TEST_F(PathsPanel, EditOfTheViewOutdatesTheTableUntilItIsMeasuredAgain) {
  const auto steps =
      joined(measured(), steps_of({set("material.5.metallic", 1), file_step("state", path("stale.json")),
                                   click("paths.measure"), wait_for("paths"), file_step("state", path("anew.json"))}));
  ASSERT_EQ(run(steps), 0);
  const auto stale = state("stale.json"), anew = state("anew.json");
  EXPECT_FALSE(stale["paths"]["fresh"]);
  EXPECT_FALSE(stale["paths"]["rows"].empty());
  EXPECT_TRUE(anew["paths"]["fresh"]);
  EXPECT_NE(anew["paths"]["rows"], stale["paths"]["rows"]);
}

TEST_F(PathsPanel, CoverageOfTheIntegratorFollowsFromTheTable) {
  const auto steps = joined(measured(), steps_of({set("path.max-depth", 2), file_step("state", path("cut.json"))}));
  ASSERT_EQ(run(steps), 0);
  const auto paths = state("cut.json")["paths"];
  EXPECT_TRUE(paths["fresh"]);  // another method shows the same view
  EXPECT_GT(paths["missing_share"], 0.05);
  bool lacks = false;
  for (const auto& row : paths["rows"]) lacks = lacks || row["found"] != "yes";
  EXPECT_TRUE(lacks);
}

TEST_F(PathsPanel, ExpressionsAreValidated) {
  ASSERT_EQ(run(joined(small(), steps_of({set("film.paths", "ES*DL"), file_step("state", path("set.json")),
                                          click("film.paths"), key("ctrl+a"), key("shift+e"), key("shift+l"),
                                          key("enter"), file_step("state", path("typed.json"))}))),
            0);
  EXPECT_EQ(state("set.json")["parameters"]["film.paths"], "ES*DL");
  EXPECT_EQ(state("set.json")["undo_depth"], kDepth + 1);
  EXPECT_EQ(state("typed.json")["parameters"]["film.paths"], "EL");
  ::testing::internal::CaptureStderr();
  EXPECT_NE(run(steps_of({set("film.paths", "E((")})), 0);
  const auto text = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find("film.paths: "), std::string::npos) << text;
}

TEST_F(PathsPanel, RecommendedMethodIsUsedInOneStep) {
  const auto steps = joined(
      small(), steps_of({set("render.integrator", "path-pure"), set("advice.pilot", 0.125), set("advice.error", 0.5),
                         click("advice.ask"), file_step("state", path("asked.json")), wait_for("advice"),
                         // What the method misses is measured after that, and said above the ranking: it moves down.
                         wait_for("misses"), file_step("state", path("told.json")), click("advice.use.0"),
                         file_step("state", path("used.json")), key("ctrl+z"), file_step("state", path("back.json"))}));
  ASSERT_EQ(run(steps), 0);
  const auto told = state("told.json"), used = state("used.json"), back = state("back.json");
  EXPECT_FALSE(told["advice"]["running"]);
  EXPECT_FALSE(told["paused"]);
  ASSERT_TRUE(told["advice"]["best"].is_string());
  const std::string best = told["advice"]["best"];
  EXPECT_EQ(used["parameters"]["render.integrator"].get<std::string>() +
                ":sampler=" + used["parameters"]["render.sampler"].get<std::string>(),
            best);
  EXPECT_NEAR(used["parameters"]["render.error"].get<double>(), 0.5, 1e-6);
  EXPECT_EQ(used["undo_depth"], told["undo_depth"].get<int>() + 1);
  EXPECT_EQ(back["parameters"], told["parameters"]);
}

TEST_F(PathsPanel, EditCancelsTheRecommendation) {
  const auto steps = joined(small(), steps_of({set("advice.pilot", 60), set("advice.error", 1e-5), click("advice.ask"),
                                               file_step("state", path("asked.json")), set("material.5.metallic", 1),
                                               file_step("state", path("edited.json")), click("advice.ask"),
                                               click("advice.stop"), file_step("state", path("stopped.json"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_TRUE(state("asked.json")["advice"]["running"]);
  EXPECT_TRUE(state("asked.json")["paused"]);
  for (const char* name : {"edited.json", "stopped.json"}) {
    EXPECT_FALSE(state(name)["advice"]["running"]) << name;
    EXPECT_FALSE(state(name)["paused"]) << name;
  }
}

}  // namespace
}  // namespace etendue::paths_test
