// The Convergence panel: comparison of methods, its curves, and their export.
#include <cstdlib>
#include <sstream>

#include "scripted.h"

namespace etendue {
namespace {

// Waits until each method has this many samples; and until the comparison has stopped and files are written.
json compared(int samples) { return {{"do", "wait"}, {"compared", samples}}; }
const json kAtRest = {{"do", "wait"}, {"for", "contest"}};

class ConvergencePanel : public Viewer {
 protected:
  void SetUp() override {
    Viewer::SetUp();
    ::setenv("XDG_CACHE_HOME", folder_.c_str(), 1);  // references of tests are nobody's
  }

  // A comparison of two methods that runs until it is stopped.
  static json begun() {
    return joined(small(), json::array({click("panel.convergence"), set("compare.seconds", 1000),
                                        click("compare.start"), compared(8)}));
  }
  json exported(const std::string& name) const {
    return json::array({click("compare.export"), set("files.name", path(name)), click("files.accept"), kAtRest});
  }

  std::string text(const std::string& name) const {
    std::ifstream in(path(name));
    std::stringstream all;
    all << in.rdbuf();
    return all.str();
  }
};

TEST_F(ConvergencePanel, MethodsAreRenderedInTurnsAndCurvesAreExported) {
  auto steps =
      joined(begun(), json::array({file_step("state", path("begun.json")), file_step("screenshot", path("chart.png")),
                                   click("compare.stop"), kAtRest, file_step("state", path("stopped.json"))}));
  for (const char* name : {"a.svg", "a.csv", "a.png"}) steps = joined(steps, exported(name));
  steps = joined(steps, json::array({click("compare.go-on"), file_step("state", path("on.json"))}));
  ASSERT_EQ(run(steps), 0);

  const auto begun = state("begun.json")["contest"], stopped = state("stopped.json")["contest"],
             on = state("on.json")["contest"];
  EXPECT_TRUE(begun["running"]);
  EXPECT_FALSE(stopped["running"]);
  EXPECT_EQ(stopped["phase"], "stopped");
  EXPECT_TRUE(on["running"]);
  ASSERT_EQ(stopped["methods"].size(), 2u);
  EXPECT_EQ(stopped["methods"][0]["name"], "path:sampler=sobol");
  EXPECT_EQ(stopped["methods"][1]["name"], "path:sampler=random");
  for (size_t m = 0; m < 2; ++m) {
    EXPECT_GT(stopped["methods"][m]["samples"], 1);
    EXPECT_GT(stopped["methods"][m]["seconds"], 0);
    EXPECT_GT(stopped["methods"][m]["rmse"], 0);
    EXPECT_LT(stopped["methods"][m]["slope"], -0.2);
    EXPECT_GE(on["methods"][m]["samples"], stopped["methods"][m]["samples"]);
  }
  EXPECT_GT(stopped["reference"]["samples"], 1);
  // The main rendering is paused during the comparison.
  EXPECT_TRUE(state("begun.json")["paused"]);
  EXPECT_FALSE(state("stopped.json")["paused"]);
  EXPECT_EQ(state("begun.json")["comparison"]["mode"], "wipe");
  EXPECT_TRUE(state("begun.json")["comparison"]["a"].get<std::string>().starts_with("path, sobol, "));
  EXPECT_TRUE(state("begun.json")["comparison"]["b"].get<std::string>().starts_with("path, random, "));

  EXPECT_TRUE(text("a.svg").starts_with("<svg"));
  EXPECT_NE(text("a.svg").find("path, random"), std::string::npos);
  EXPECT_TRUE(text("a.csv").starts_with("method,repeat,seconds,spp,mse"));
  EXPECT_NE(text("a.csv").find("\"path:sampler=random\",0,"), std::string::npos);
  EXPECT_TRUE(image::read_linear(path("a.png")));
}

TEST_F(ConvergencePanel, MethodsOfTheListGetEqualSamples) {
  const auto steps = joined(
      small(),
      json::array({click("panel.convergence"), set("compare.rule", "samples"), set("compare.samples", 6),
                   set("compare.repeats", 2), set("compare.integrator", "path-pure"), set("compare.sampler", "sobol"),
                   click("compare.add"), click("compare.add"), click("compare.remove.1"), click("compare.start"),
                   kAtRest, file_step("state", path("s.json"))}));
  ASSERT_EQ(run(steps), 0);
  const auto contest = state("s.json")["contest"];
  EXPECT_EQ(contest["phase"], "done");
  EXPECT_EQ(contest["repeat"], 2);
  ASSERT_EQ(contest["methods"].size(), 2u);
  EXPECT_EQ(contest["methods"][1]["name"], "path-pure:sampler=sobol");
  for (const auto& m : contest["methods"]) EXPECT_EQ(m["samples"], 6);
}

TEST_F(ConvergencePanel, EditOfTheSceneStopsTheComparisonAndKeepsTheCurves) {
  const auto steps = joined(begun(), json::array({set("camera.exposure", 1),
                                                  file_step("state", path("exposed.json")),
                                                  set("material.5.metallic", 1),
                                                  {{"do", "wait"}, {"spp", 1}},
                                                  file_step("state", path("edited.json")),
                                                  click("compare.start"),
                                                  compared(1),
                                                  file_step("state", path("again.json"))}));
  ASSERT_EQ(run(steps), 0);
  // An edit of the display does not stop it.
  EXPECT_TRUE(state("exposed.json")["contest"]["running"]);
  const auto edited = state("edited.json");
  EXPECT_FALSE(edited["contest"]["running"]);
  EXPECT_FALSE(edited["contest"]["up_to_date"]);
  EXPECT_GT(edited["contest"]["methods"][0]["samples"], 0);
  EXPECT_FALSE(edited["paused"]);
  EXPECT_EQ(edited["comparison"]["mode"], "off");
  EXPECT_TRUE(state("again.json")["contest"]["up_to_date"]);
}

}  // namespace
}  // namespace etendue
