// The Radiosity panel: the residual of the solver, and patches over the image.
#include "scripted.h"

namespace etendue::radiosity_test {
namespace {

class RadiosityPanel : public Viewer {
 protected:
  // A small image by radiosity, with its panel open.
  static json radiosity_steps(const json::array_t& steps) {
    const json::array_t begin{set("render.integrator", "radiosity"), set("radiosity.patches", 200),
                              set("radiosity.rays", 32), click("panel.radiosity")};
    return joined(joined(small(), json(begin)), json(steps));
  }
};

TEST_F(RadiosityPanel, ShowsTheSolution) {
  ASSERT_EQ(
      run(radiosity_steps({wait_for("radiosity"), set("patches.overlay", "closure"), set("patches.axis", "seconds"),
                           file_step("state", path("a.json")), file_step("screenshot", path("a.png"))})),
      0);
  const json radiosity = state("a.json")["radiosity"];
  EXPECT_TRUE(radiosity["complete"].get<bool>());
  EXPECT_GT(radiosity["patches"], 100);
  EXPECT_GT(radiosity["visible_patches"], 50);
  EXPECT_LT(radiosity["visible_patches"], radiosity["patches"]);
  EXPECT_GT(radiosity["sweeps"], 2);
  EXPECT_EQ(radiosity["problem"], "");
}

// An adaptive mesh has no form factors while it is being refined, which is no lack of a solution.
TEST_F(RadiosityPanel, WaitsForAnAdaptiveMesh) {
  ASSERT_EQ(run(radiosity_steps({set("radiosity.patches", 2000), set("radiosity.meshing", "adaptive"),
                                 wait_for("radiosity"), file_step("state", path("a.json"))})),
            0);
  EXPECT_TRUE(state("a.json")["radiosity"]["complete"].get<bool>());
}

TEST_F(RadiosityPanel, NotesDivergence) {
  ASSERT_EQ(run(radiosity_steps({set("radiosity.solver", "sor"),
                                 set("radiosity.relaxation", 3),
                                 wait_for("radiosity"),
                                 {{"do", "wait"}, {"spp", 2}},
                                 file_step("state", path("a.json"))})),
            0);
  EXPECT_NE(state("a.json")["radiosity"]["problem"].get<std::string>().find("diverges"), std::string::npos);
  ASSERT_FALSE(state("a.json")["notes"].empty());
  EXPECT_NE(state("a.json")["notes"][0].get<std::string>().find("direct light only"), std::string::npos);
}

TEST_F(RadiosityPanel, SaysThatOtherIntegratorsHaveNoSolution) {
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(run(joined(small(), json(json::array_t({click("panel.radiosity"), wait_for("radiosity")})))), 1);
  EXPECT_NE(::testing::internal::GetCapturedStderr().find("has no radiosity solution"), std::string::npos);
}

}  // namespace
}  // namespace etendue::radiosity_test
