// The region of interest receives all samples. It is not an edit of the document.
#include "scripted.h"

namespace etendue::focus_region_test {
namespace {

json drag(Vec2 from, Vec2 to) { return {{"do", "drag"}, {"from", {from.x, from.y}}, {"to", {to.x, to.y}}}; }

// The viewport that scripts see at 900 x 560 contains these points.
const Vec2 kFrom(200, 150), kTo(300, 260);

TEST_F(Viewer, RegionReceivesTheSamplesUntilItIsCleared) {
  const auto steps = joined(
      small(16), json::array({file_step("state", path("before.json")), file_step("image", path("before.exr")),
                              set("render.samples", 80), key("b"), drag(kFrom, kTo), wait_for("limit"),
                              file_step("state", path("region.json")), file_step("image", path("region.exr")),
                              click("view.clear-region"), wait_for("limit"), file_step("state", path("cleared.json")),
                              file_step("image", path("cleared.exr"))}));
  ASSERT_EQ(run(steps), 0);
  const json region = state("region.json"), cleared = state("cleared.json");
  ASSERT_FALSE(region["region"].is_null());
  EXPECT_EQ(region["region"]["samples"], 80);
  EXPECT_LT(region["samples"], 80);
  EXPECT_TRUE(cleared["region"].is_null());
  EXPECT_EQ(cleared["samples"], 80);
  // The only edit is that of the limit.
  EXPECT_EQ(region["undo_depth"].get<int>(), state("before.json")["undo_depth"].get<int>() + 1);
  EXPECT_EQ(cleared["undo_depth"], region["undo_depth"]);
  // The pixels are those under the drag.
  const json image = region["image"], pixels = region["region"]["pixels"];
  const double scale = 96 / image[2].get<double>();
  EXPECT_EQ(pixels[0], std::floor((kFrom.x - image[0].get<double>()) * scale));
  EXPECT_EQ(pixels[1], std::floor((kFrom.y - image[1].get<double>()) * scale));
  EXPECT_NEAR(pixels[2].get<double>(), (kTo.x - kFrom.x) * scale, 2);
  EXPECT_NEAR(pixels[3].get<double>(), (kTo.y - kFrom.y) * scale, 2);
  // The finished image has the bits of an image that never had a region.
  ASSERT_EQ(run(joined(small(80), json::array({file_step("image", path("plain.exr"))}))), 0);
  EXPECT_EQ(saved_image("cleared.exr").find("")->pixels, saved_image("plain.exr").find("")->pixels);
  EXPECT_NE(saved_image("region.exr").find("")->pixels, saved_image("plain.exr").find("")->pixels);
}

TEST_F(Viewer, RegionIsClearedByEscapeAndTheCameraKeepsItsPlace) {
  const auto steps = joined(
      small(4),
      json::array({file_step("state", path("before.json")), click("view.region"), drag(kFrom, kTo),
                   file_step("state", path("region.json")), key("escape"), file_step("state", path("escaped.json")),
                   key("b"), key("escape"), drag(kFrom, kTo), file_step("state", path("orbit.json"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_EQ(state("region.json")["parameters"], state("before.json")["parameters"]);
  EXPECT_TRUE(state("escaped.json")["region"].is_null());
  EXPECT_TRUE(state("orbit.json")["region"].is_null());
  EXPECT_EQ(state("orbit.json")["undo"], "Orbit");  // Escape has ended the selection
}

TEST_F(Viewer, RegionSaysWhyItReceivesNoSamples) {
  const auto steps = joined(small(4), json::array({set("render.integrator", "bdpt"),
                                                   key("b"),
                                                   drag(kFrom, kTo),
                                                   {{"do", "wait"}, {"spp", 4}},
                                                   file_step("state", path("bdpt.json")),
                                                   set("render.integrator", "path"),
                                                   wait_for("limit"),
                                                   file_step("state", path("path.json"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_NE(state("bdpt.json")["region"]["note"], "");
  EXPECT_EQ(state("path.json")["region"]["note"], "");
  EXPECT_EQ(state("path.json")["region"]["samples"], 4);
}

}  // namespace
}  // namespace etendue::focus_region_test
