// Panels in windows of their own.
#include <string>

#include "scripted.h"

namespace etendue::detached_panels_test {
namespace {

TEST_F(Viewer, DetachedPanelsStayOpenBesideOthersAndReturn) {
  const auto steps =
      joined(small(), json::array({click("panel.histogram"),
                                   click("layout.detach"),
                                   file_step("state", path("detached.json")),
                                   click("panel.convergence"),
                                   wait_for("histogram"),
                                   file_step("state", path("both.json")),
                                   {{"do", "drag"}, {"item", "detached.panel.histogram"}, {"by", {60, 40}}},
                                   file_step("state", path("moved.json")),
                                   click("panel.histogram"),
                                   file_step("state", path("returned.json"))}));
  ASSERT_EQ(run(steps, "cornell", 1280, 720), 0);
  ASSERT_TRUE(state("both.json")["detached"].contains("panel.histogram"));
  EXPECT_EQ(state("detached.json")["bottom_panel"], "");
  const auto before = state("both.json")["detached"]["panel.histogram"].get<std::vector<double>>();
  const auto after = state("moved.json")["detached"]["panel.histogram"].get<std::vector<double>>();
  EXPECT_NEAR(after[0] - before[0], 60, 1);
  EXPECT_NEAR(after[1] - before[1], 40, 1);
  EXPECT_EQ(state("both.json")["bottom_panel"], "panel.convergence");
  EXPECT_TRUE(state("returned.json")["detached"].empty());
  EXPECT_EQ(state("returned.json")["bottom_panel"], "panel.convergence");
}

TEST_F(Viewer, TabsOfTheRightColumnAreDetachedByTheirMenu) {
  const json menu{{"do", "click"}, {"item", "tab.material"}, {"button", "right"}};
  const auto steps =
      joined(small(), json::array({click("tab.material"), menu, click("tab-menu.detach"),
                                   file_step("state", path("detached.json")), set("material.5.roughness", 0.25),
                                   set("camera.exposure", 1.0), file_step("state", path("edited.json")),
                                   click("view.tab.material"), file_step("state", path("returned.json"))}));
  ASSERT_EQ(run(steps, "cornell", 1280, 720), 0);
  EXPECT_TRUE(state("detached.json")["detached"].contains("tab.material"));
  EXPECT_NE(state("detached.json")["tab"], "tab.material");
  EXPECT_EQ(state("edited.json")["parameters"]["material.5.roughness"], 0.25);
  EXPECT_TRUE(state("edited.json")["detached"].contains("tab.material"));
  EXPECT_TRUE(state("returned.json")["detached"].empty());
  EXPECT_EQ(state("returned.json")["tab"], "tab.material");
}

// The filter hides the other parameters of its own window only.
TEST_F(Viewer, DetachedPanelsHaveAFilter) {
  const json menu{{"do", "click"}, {"item", "tab.material"}, {"button", "right"}};
  const std::string filter = "detached.tab.material.filter";
  const auto steps = joined(small(), json::array({click("tab.material"),
                                                  menu,
                                                  click("tab-menu.detach"),
                                                  set("material.5.roughness", 0.25),
                                                  file_step("state", path("detached.json")),
                                                  click(filter),
                                                  {{"do", "type"}, {"text", "roughness"}},
                                                  file_step("state", path("filtered.json")),
                                                  click(filter + ".clear"),
                                                  file_step("state", path("cleared.json"))}));
  ASSERT_EQ(run(steps, "cornell", 1280, 720), 0);
  const auto shows = [&](const char* file, const char* item) { return state(file)["items"].contains(item); };
  for (const char* file : {"detached.json", "cleared.json"}) {
    EXPECT_TRUE(shows(file, "material.5.roughness")) << file;
    EXPECT_TRUE(shows(file, "material.5.metallic")) << file;
  }
  EXPECT_TRUE(shows("filtered.json", "material.5.roughness"));
  EXPECT_FALSE(shows("filtered.json", "material.5.metallic"));
  EXPECT_TRUE(shows("filtered.json", "film.height")) << "a parameter of the column";
}

}  // namespace
}  // namespace etendue::detached_panels_test
