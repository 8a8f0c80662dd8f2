// The values of a pinned pixel, and the Histogram panel.
#include <cmath>

#include "image/display.h"
#include "scripted.h"

namespace etendue {
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

}  // namespace
}  // namespace etendue
