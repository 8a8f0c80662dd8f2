// The Convergence panel: comparison of methods, its curves, and their export.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "scripted.h"

namespace etendue::convergence_test {
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

// A denoised method has a curve of its own, and its image is the one of the viewport.
TEST_F(ConvergencePanel, DenoisedImagesAreMethods) {
  const auto steps =
      joined(small(),
             json::array({click("panel.convergence"), set("compare.rule", "samples"), set("compare.samples", 4),
                          set("compare.repeats", 1), set("compare.denoised", true), click("compare.add"),
                          click("compare.start"), kAtRest, click("compare.b.2"), file_step("state", path("s.json"))}));
  ASSERT_EQ(run(steps), 0);
  const json s = state("s.json");
  const json methods = s["contest"]["methods"];
  ASSERT_EQ(methods.size(), 3u);
  EXPECT_EQ(methods[2]["name"], "path:sampler=sobol:denoise=true");
  EXPECT_EQ(methods[2]["repeats"], 1);
  EXPECT_NE(s["comparison"]["b"].get<std::string>().find("denoised"), std::string::npos);
}

// The table shows the median of the complete repeats at the end of the curve, in the chosen measure. A method that cannot
// render the scene has no error.
TEST_F(ConvergencePanel, TableShowsTheEndOfTheCurveInTheChosenMeasure) {
  const auto steps = joined(
      small(), json::array({click("panel.convergence"), set("compare.rule", "samples"), set("compare.samples", 8),
                            set("compare.repeats", 3), set("compare.integrator", "light-pure"), click("compare.add"),
                            set("compare.axis", "samples"), click("compare.start"), kAtRest,
                            file_step("state", path("rmse.json")), set("compare.error", "relative"),
                            file_step("state", path("relative.json")), file_step("screenshot", path("chart.png"))}));
  const json compare_missing =
      json::array({click("compare.a.2"), click("compare.difference"), file_step("state", path("missing.json"))});
  const auto all = joined(joined(steps, exported("a.csv")), compare_missing);
  ASSERT_EQ(run(all), 0);
  const auto rmse = state("rmse.json")["contest"]["methods"], relative = state("relative.json")["contest"]["methods"];
  ASSERT_EQ(rmse.size(), 3u);
  EXPECT_EQ(rmse[0]["incompatibility"], "");
  EXPECT_NE(rmse[2]["incompatibility"], "");
  EXPECT_TRUE(rmse[2]["error"].is_null());
  EXPECT_EQ(rmse[2]["repeats"], 0);
  const json comparison = state("missing.json")["comparison"];
  EXPECT_EQ(comparison["a"].get<std::string>().substr(0, 10), "light-pure") << "the live image does not stand in";
  EXPECT_EQ(comparison["problem"].get<std::string>().substr(0, 6), "A: n/a");
  for (size_t m = 0; m < 2; ++m) {
    EXPECT_EQ(rmse[m]["repeats"], 3);
    // The errors of all repeats at 8 samples per pixel.
    std::vector<double> ends, relative_ends;
    std::istringstream csv(text("a.csv"));
    for (std::string line; std::getline(csv, line);) {
      if (line.find(rmse[m]["name"].get<std::string>()) == std::string::npos) continue;
      std::vector<double> numbers;
      std::istringstream fields(line.substr(line.rfind('"') + 2));
      for (std::string field; std::getline(fields, field, ',');) numbers.push_back(std::stod(field));
      if (numbers[2] != 8) continue;
      ends.push_back(std::sqrt(numbers[3]));
      relative_ends.push_back(std::sqrt(numbers[4]));
    }
    ASSERT_EQ(ends.size(), 3u);
    std::ranges::sort(ends);
    std::ranges::sort(relative_ends);
    EXPECT_NEAR(rmse[m]["error"].get<double>(), ends[1], 1e-6 * ends[1]);
    EXPECT_NEAR(relative[m]["error"].get<double>(), relative_ends[1], 1e-6 * relative_ends[1]);
  }
}

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

// Three methods besides the two proposals, for an equal number of samples. A click on the last one uses it.
TEST_F(ConvergencePanel, ParetoChartOffersItsMethods) {
  json steps = small(1);
  for (const json& step : {click("panel.convergence"),
                           set("compare.methods", "path-pure,path:path.roulette-start={2,8}"),
                           set("compare.rule", "samples"),
                           set("compare.samples", 4),
                           set("compare.repeats", 2),
                           set("compare.chart-type", "pareto"),
                           click("compare.start"),
                           kAtRest,
                           set("render.integrator", "auto"),  // which the method replaces
                           click("compare.point.4"),
                           {{"do", "wait"}, {"spp", 1}},
                           file_step("state", path("used.json")),
                           set("compare.methods", "{path,unknown}"),
                           file_step("state", path("refused.json"))})
    steps.push_back(step);
  ASSERT_EQ(run(steps, "cornell", 1280, 900), 0);
  const json used = state("used.json");
  ASSERT_EQ(used["contest"]["methods"].size(), 5U) << used["contest"];
  EXPECT_EQ(used["parameters"]["render.integrator"], "path");
  EXPECT_EQ(used["parameters"]["path.roulette-start"], 8);
  EXPECT_EQ(used["undo"], "Method");
  const json errors = state("refused.json")["errors"];
  ASSERT_EQ(errors.size(), 1U) << errors;
  EXPECT_NE(errors[0].get<std::string>().find("unknown"), std::string::npos) << errors;
  EXPECT_EQ(state("refused.json")["contest"]["methods"].size(), 5U);
}

}  // namespace
}  // namespace etendue::convergence_test
