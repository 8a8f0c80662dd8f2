// The Lab panel: experiments run in the background, again after each change of a parameter.
#include "scripted.h"

namespace etendue::lab_test {
namespace {

class LabPanel : public Viewer {};

const json kWaitForExperiment = {{"do", "wait"}, {"for", "lab"}};

TEST_F(LabPanel, RunsTheExperimentWithItsParameters) {
  const auto steps = json::array({click("panel.lab"), kWaitForExperiment, file_step("state", path("a.json")),
                                  set("lab.experiment", "sampling"), set("lab.sampling.density", "semicircle"),
                                  kWaitForExperiment, file_step("state", path("b.json")), set("lab.seed", 1),
                                  kWaitForExperiment, file_step("state", path("c.json"))});
  ASSERT_EQ(run(steps), 0);
  const json a = state("a.json")["lab"], b = state("b.json")["lab"], c = state("c.json")["lab"];
  EXPECT_EQ(a["experiment"], "quadrature");
  for (const json& check : a["checks"]) EXPECT_TRUE(check["holds"].get<bool>()) << check;
  ASSERT_EQ(b["experiment"], "sampling");
  EXPECT_EQ(b["charts"], 1);
  // The acceptance rate of rejection sampling is that of a half circle in its square.
  EXPECT_NEAR(b["table"]["rows"][4][1].get<double>(), 0.7853982, 1e-6);
  EXPECT_NE(b["table"], c["table"]) << "another seed gives other samples";
}

TEST_F(LabPanel, ShowsWhyThereIsNoResult) {
  const auto steps = json::array({click("panel.lab"), set("lab.experiment", "random-walks"),
                                  set("lab.random-walks.equation", "logarithmic"), kWaitForExperiment,
                                  file_step("state", path("state.json")), file_step("screenshot", path("a.png"))});
  ASSERT_EQ(run(steps), 0);
  EXPECT_NE(state("state.json")["lab"]["error"].get<std::string>().find("the Neumann series diverges"),
            std::string::npos);
}

TEST_F(LabPanel, RefusesValuesOutOfRange) {
  EXPECT_NE(run(json::array({click("panel.lab"), set("lab.quadrature.dimension", 0)})), 0);
  EXPECT_NE(run(json::array({click("panel.lab"), set("lab.quadrature.dimension", 10000)})), 0);
}

}  // namespace
}  // namespace etendue::lab_test
