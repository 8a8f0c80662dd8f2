// The values of a pinned pixel, and the Histogram panel.
#include <cmath>

#include "image/display.h"
#include "scripted.h"

namespace etendue::pixel_values_test {
namespace {

class PixelValues : public Viewer {};

// The values are those of the saved image: radiance, and the number of samples.
TEST_F(PixelValues, PinnedPixelHasTheValuesOfTheImage) {
  const json steps = joined(small(16), json::array({key("i"),
                                                    click("view.pin-pixel"),
                                                    {{"do", "drag"}, {"from", {300, 240}}, {"to", {300, 240}}},
                                                    wait_for("pixel-values"),
                                                    file_step("state", path("state.json")),
                                                    file_step("image", path("image.exr"))}));
  ASSERT_EQ(run(steps, "cornell"), 0);
  const json pinned = state("state.json")["pixel_values"]["pinned"];
  ASSERT_TRUE(pinned.is_object());
  const auto image = saved_image("image.exr");
  const size_t i = 3 * (pinned["y"].get<size_t>() * 96 + pinned["x"].get<size_t>());
  const auto& pixels = image.layers.at(0).pixels;
  const Rgb radiance(pixels.at(i), pixels.at(i + 1), pixels.at(i + 2));
  const Rgb displayed = image::displayed(radiance, 0, image::ToneCurve::none);
  for (int k = 0; k < 3; ++k) {
    EXPECT_FLOAT_EQ(pinned["radiance"][static_cast<size_t>(k)].get<float>(), radiance[k]);
    EXPECT_FLOAT_EQ(pinned["displayed"][static_cast<size_t>(k)].get<float>(), displayed[k]);
  }
  EXPECT_EQ(pinned["samples"], 16);
  EXPECT_GT(pinned["standard_error"].get<double>(), 0);
  EXPECT_FALSE(pinned["preview"].get<bool>());
}

TEST_F(PixelValues, UnpinnedPixelIsNotShown) {
  const json steps = joined(small(2), json::array({click("view.pin-pixel"),
                                                   {{"do", "drag"}, {"from", {300, 240}}, {"to", {300, 240}}},
                                                   click("view.unpin-pixel"),
                                                   file_step("state", path("state.json"))}));
  ASSERT_EQ(run(steps, "cornell"), 0);
  EXPECT_TRUE(state("state.json")["pixel_values"]["pinned"].is_null());
}

// The statistics are those of the newest image and exposure: at 10 EV nearly all lit pixels are
// clipped.
TEST_F(PixelValues, HistogramFollowsTheExposure) {
  const json steps = joined(small(4), json::array({click("panel.histogram"), wait_for("histogram"),
                                                   file_step("state", path("before.json")), set("camera.exposure", 10),
                                                   wait_for("histogram"), file_step("state", path("after.json"))}));
  ASSERT_EQ(run(steps, "cornell"), 0);
  const json before = state("before.json")["histogram"];
  const json after = state("after.json")["histogram"];
  EXPECT_EQ(before["pixels"], 96 * 96);
  EXPECT_EQ(before["black"], after["black"]);
  EXPECT_LT(before["above_white"].get<double>(), 0.2);
  EXPECT_GT(after["above_white"].get<double>(), 0.8);
}

// The charts describe the AOV that is shown: normals are shown as colours without exposure, so that none is above white.
TEST_F(PixelValues, HistogramFollowsTheAov) {
  const json steps = joined(small(4), json::array({set("camera.exposure", 10),
                                                   {{"do", "wait"}, {"spp", 4}},
                                                   click("panel.histogram"),
                                                   wait_for("histogram"),
                                                   file_step("state", path("beauty.json")),
                                                   set("view.aov", "shading-normal"),
                                                   wait_for("aov"),
                                                   wait_for("histogram"),
                                                   file_step("state", path("normal.json"))}));
  ASSERT_EQ(run(steps, "cornell"), 0);
  const json beauty = state("beauty.json")["histogram"], normal = state("normal.json")["histogram"];
  EXPECT_EQ(beauty["source"], "beauty");
  EXPECT_GT(beauty["above_white"].get<double>(), 0.8);
  EXPECT_EQ(normal["source"], "shading-normal");
  EXPECT_EQ(normal["above_white"], 0);
}

// The window with the values follows a drag by its head, and keeps its place for the next start.
TEST_F(PixelValues, WindowIsDraggedAndKeepsItsPlace) {
  const auto run_with_settings = [&](const json& steps) {
    std::ofstream(path("steps.json")) << steps.dump();
    viewer::ViewOptions options;
    options.scene = "cornell";
    options.offscreen = true;
    options.script = path("steps.json");
    options.settings = path("settings");
    options.width = 1280;
    options.height = 720;
    return viewer::run_viewer(options);
  };
  const auto drag = [](int x, int y) { return json{{"do", "drag"}, {"item", "pixel-values.window"}, {"by", {x, y}}}; };
  const json start = json::array({{{"do", "wait"}, {"spp", 1}}, key("i")});
  ASSERT_EQ(run_with_settings(joined(start, json::array({file_step("state", path("first.json")), drag(-300, 200),
                                                         file_step("state", path("moved.json"))}))),
            0);
  ASSERT_EQ(run_with_settings(joined(start, json::array({file_step("state", path("again.json")), drag(-3000, 3000),
                                                         file_step("state", path("corner.json")),
                                                         file_step("screenshot", path("corner.png"))}))),
            0);
  const auto window = [&](const char* file) { return state(file)["pixel_values"]["window"]; };
  const json first = window("first.json"), moved = window("moved.json"), again = window("again.json");
  EXPECT_NEAR(moved[0].get<double>(), first[0].get<double>() - 300, 1);
  EXPECT_NEAR(moved[1].get<double>(), first[1].get<double>() + 200, 1);
  EXPECT_EQ(again[0], moved[0]);
  EXPECT_EQ(again[1], moved[1]);
  EXPECT_EQ(window("corner.json")[0], 0) << "it stays in the viewport";
}

// Without a limit, images follow each other before the histogram of one is complete.
TEST_F(PixelValues, HistogramIsAwaitedWhileTheImageImproves) {
  ASSERT_EQ(run(json::array({click("panel.histogram"), wait_for("histogram"), file_step("state", path("state.json"))}),
                "cornell"),
            0);
  EXPECT_GT(state("state.json")["histogram"]["pixels"], 0);
}

// An exposure that changes within half a second of a computation is taken up without an event. The histogram follows
// after half a second; the script waits longer, because other programs may use the processors, and asks for no frames
// meanwhile.
TEST_F(PixelValues, HistogramIsNeverOutdatedForLong) {
  const json steps = joined(small(4), json::array({click("panel.histogram"),
                                                   wait_for("histogram"),
                                                   set("camera.exposure", 4),
                                                   wait_for("histogram"),
                                                   set("camera.exposure", 10),
                                                   {{"do", "wait"}, {"seconds", 5}},
                                                   file_step("state", path("after.json"))}));
  ASSERT_EQ(run(steps, "cornell"), 0);
  EXPECT_GT(state("after.json")["histogram"]["above_white"].get<double>(), 0.8);
}

}  // namespace
}  // namespace etendue::pixel_values_test
