// The Trace panel: the sample of the selected pixel, after edits, and its files.
#include <filesystem>

#include "scripted.h"

namespace etendue::trace_test {
namespace {

class TracePanel : public Viewer {};

json click_at(int x, int y) { return {{"do", "drag"}, {"from", {x, y}}, {"to", {x, y}}}; }
const json kWaitForTrace = {{"do", "wait"}, {"for", "trace"}};

TEST_F(TracePanel, ShowsTheSampleOfTheClickedPixel) {
  const auto steps = joined(
      small(),
      json::array({click("trace.pick"), click_at(300, 200), kWaitForTrace, file_step("state", path("a.json")),
                   set("trace.sample", 5), kWaitForTrace, file_step("state", path("b.json")),
                   set("trace.shadow-rays", false), set("path.max-depth", 2), kWaitForTrace,
                   file_step("state", path("c.json")), file_step("screenshot", path("c.png")), click("trace.export"),
                   set("files.name", path("a.svg")), click("files.accept"), kWaitForTrace}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_TRUE(std::filesystem::exists(path("a.svg")));
  const json a = state("a.json")["trace"], b = state("b.json")["trace"], c = state("c.json")["trace"];
  EXPECT_EQ(a["radiance"], a["film_sample"]);
  EXPECT_EQ(a["sample"], 0);
  EXPECT_EQ(b["sample"], 5);
  EXPECT_EQ(b["pixel"], a["pixel"]);
  EXPECT_NE(b["raster"], a["raster"]);
  EXPECT_EQ(state("a.json")["bottom_panel"], "panel.trace");
  EXPECT_GE(c["vertices"].size(), 1u);
  for (const json& vertex : c["vertices"]) EXPECT_LE(vertex["length"], 2);
}

TEST_F(TracePanel, OtherIntegratorsHaveNoTrace) {
  const auto steps = joined(small(), json::array({click("trace.pick"),
                                                  click_at(300, 200),
                                                  kWaitForTrace,
                                                  set("render.integrator", "bdpt"),
                                                  {{"do", "wait"}, {"spp", 1}},
                                                  file_step("screenshot", path("a.png")),
                                                  file_step("state", path("a.json"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_FALSE(state("a.json").contains("trace"));
}

}  // namespace
}  // namespace etendue::trace_test
