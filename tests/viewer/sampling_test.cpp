// The Sampling panel: samples of the selected pixel, and which edits restart them.
#include <cmath>

#include "scripted.h"
#include "viewer/panels/interval_grid.h"
#include "viewer/tasks/pixel_samples_task.h"
#include "viewer/tasks/point_playback.h"

namespace etendue::sampling_test {
namespace {

class SamplingPanel : public Viewer {};

// A click in the image that selects no object.
json click_at(int x, int y) { return {{"do", "drag"}, {"from", {x, y}}, {"to", {x, y}}}; }
const json kWaitForSamples = {{"do", "wait"}, {"for", "pixel"}};

TEST_F(SamplingPanel, ClickedPixelHasTheMeanOfTheRendering) {
  const auto steps = joined(
      small(64), json::array({set("sampling.samples", 64), click("sampling.pick"), click_at(300, 200), kWaitForSamples,
                              file_step("state", path("a.json")), file_step("image", path("a.exr"))}));
  ASSERT_EQ(run(steps), 0);
  const json pixel = state("a.json")["pixel"];
  ASSERT_EQ(pixel["samples"], 64);
  EXPECT_EQ(state("a.json")["bottom_panel"], "panel.sampling");
  EXPECT_EQ(state("a.json")["selection"]["node"], -1);
  const auto read = saved_image("a.exr");
  const size_t index = pixel["y"].get<size_t>() * 96 + pixel["x"].get<size_t>();
  for (size_t c = 0; c < 3; ++c) {
    const double expected = double{read.find("")->pixels[3 * index + c]};
    ASSERT_GT(expected, 0) << "a black pixel tests nothing";
    EXPECT_NEAR(pixel["mean"][c].get<double>(), expected, 1e-5 * expected) << c;
  }
  EXPECT_GT(pixel["band"].get<double>(), 0);
  EXPECT_GE(pixel["largest"].get<double>(), pixel["luminance"].get<double>());
}

TEST_F(SamplingPanel, EditOfTheSceneRestartsAndEditOfTheDisplayDoesNot) {
  const auto steps = joined(small(), json::array({set("sampling.samples", 128),
                                                  click("sampling.pick"),
                                                  click_at(300, 200),
                                                  kWaitForSamples,
                                                  file_step("state", path("a.json")),
                                                  set("camera.exposure", 1),
                                                  kWaitForSamples,
                                                  file_step("state", path("b.json")),
                                                  set("render.integrator", "path-pure"),
                                                  {{"do", "wait"}, {"spp", 1}},
                                                  kWaitForSamples,
                                                  file_step("state", path("c.json"))}));
  ASSERT_EQ(run(steps), 0);
  const json a = state("a.json")["pixel"], b = state("b.json")["pixel"], c = state("c.json")["pixel"];
  ASSERT_EQ(a["samples"], 128);
  EXPECT_EQ(a, b);
  ASSERT_EQ(c["samples"], 128);
  EXPECT_EQ(c["x"], a["x"]);
  EXPECT_GT(c["zeros"].get<int>(), a["zeros"].get<int>()) << "light sources are hit by chance only";
}

TEST_F(SamplingPanel, AllDimensionsCanBeSelectedAndUnknownOnesAreRefused) {
  const auto steps = joined(
      small(),
      json::array({click("sampling.pick"), click_at(300, 200), set("sampling.x", "vertex-2.light-choice"),
                   set("sampling.y", "vertex-4.roulette"), set("sampling.points", 2048),
                   set("sampling.compare", "blue-noise"), set("sampling.intervals", "columns"),
                   file_step("screenshot", path("a.png")), kWaitForSamples, file_step("state", path("a.json"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_TRUE(state("a.json").contains("pixel"));
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}}, set("sampling.x", "vertex-9.lobe")})), 1);
  EXPECT_NE(::testing::internal::GetCapturedStderr().find("vertex-9.lobe"), std::string::npos);
}

// At a wall of the Cornell box: every path draws a direction and a light sample there, and ends by roulette later.
TEST_F(SamplingPanel, DrawnDimensionsAreThoseOfThePathsOfThePixel) {
  const auto of_integrator = [&](const char* integrator) {
    const auto steps = joined(
        small(), json::array({set("render.integrator", integrator), set("sampling.samples", 64), click("sampling.pick"),
                              click_at(300, 200), kWaitForSamples, file_step("state", path("a.json"))}));
    EXPECT_EQ(run(steps), 0);
    return state("a.json")["pixel"]["drawn_dimensions"];
  };
  const json drawn = of_integrator("path");
  for (const char* always : {"pixel-x", "pixel-y", "vertex-1.direction-x", "vertex-1.light-x", "vertex-1.light-choice"})
    EXPECT_EQ(drawn.value(always, 0.0), 1) << always;
  for (const char* never : {"lens-u", "time", "vertex-1.roulette"}) EXPECT_FALSE(drawn.contains(never)) << never;
  const double fourth = drawn.value("vertex-4.roulette", 0.0), later = drawn.value("vertex-8.direction-x", 0.0);
  EXPECT_GT(fourth, 0.5);
  EXPECT_LT(later, fourth);
  EXPECT_FALSE(of_integrator("path-pure").contains("vertex-1.light-x"));
}

TEST_F(SamplingPanel, PointsAppearOneByOne) {
  const auto steps = joined(small(), json::array({set("sampling.samples", 64),
                                                  set("sampling.points", 4096),
                                                  click("sampling.pick"),
                                                  click_at(300, 200),
                                                  kWaitForSamples,
                                                  file_step("state", path("all.json")),
                                                  click("sampling.play"),
                                                  {{"do", "wait"}, {"seconds", 0.3}},
                                                  file_step("state", path("playing.json")),
                                                  click("sampling.play"),
                                                  {{"do", "wait"}, {"seconds", 0.2}},
                                                  file_step("state", path("ended.json"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_EQ(state("all.json")["pixel"]["points"], 4096);
  const json playing = state("playing.json")["pixel"];
  EXPECT_EQ(playing["points_play"], true);
  EXPECT_GE(playing["points"], 1);
  EXPECT_LT(playing["points"], 4096);
  EXPECT_EQ(state("ended.json")["pixel"]["points"], 4096);
}

TEST(PointPlayback, BeginsWithOnePointAndEndsWithAll) {
  EXPECT_EQ(viewer::points_at(0, 4096), 1U);
  EXPECT_EQ(viewer::points_at(0.5, 4096), 64U);
  EXPECT_EQ(viewer::points_at(1, 4096), 4096U);
  EXPECT_EQ(viewer::points_at(3, 1), 1U);
}

TEST_F(SamplingPanel, EscapeDeactivatesTheTool) {
  const auto steps = joined(small(), json::array({click("sampling.pick"), key("escape"), click_at(300, 200),
                                                  file_step("state", path("a.json"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_FALSE(state("a.json").contains("pixel"));
}

// Two half-buffers share the points; the intervals have equal areas.
TEST(IntervalGrid, HasAsManyIntervalsAsPointsOfAHalfBuffer) {
  using viewer::interval_grid, viewer::IntervalShape;
  using Grid = std::array<int, 2>;
  EXPECT_EQ(interval_grid(IntervalShape::square, 32), (Grid{4, 4}));
  EXPECT_EQ(interval_grid(IntervalShape::square, 64), (Grid{4, 4}));
  EXPECT_EQ(interval_grid(IntervalShape::columns, 64), (Grid{32, 1}));
  EXPECT_EQ(interval_grid(IntervalShape::rows, 100), (Grid{1, 32}));
  EXPECT_EQ(interval_grid(IntervalShape::none, 64), (Grid{1, 1}));
  for (const auto shape : {IntervalShape::square, IntervalShape::columns, IntervalShape::rows})
    EXPECT_EQ(interval_grid(shape, 1), (Grid{1, 1}));
}

TEST(Histogram, CountsEachSampleOnce) {
  std::vector<float> values(100, 0.0f);
  for (int i = 0; i < 900; ++i) values.push_back(1 + static_cast<float>(i) / 900);
  const auto h = viewer::histogram_of(values);
  EXPECT_FALSE(h.logarithmic);
  EXPECT_EQ(h.zeros, 100U);
  uint32_t sum = 0;
  for (const uint32_t n : h.counts) sum += n;
  EXPECT_EQ(sum, 900U);
}

TEST(Histogram, OutlierMakesTheAxisLogarithmic) {
  std::vector<float> values(1000, 0.5f);
  values.back() = 100;
  const auto h = viewer::histogram_of(values);
  EXPECT_TRUE(h.logarithmic);
  EXPECT_EQ(h.counts.front(), 999U);
  EXPECT_EQ(h.counts.back(), 1U);
}

TEST(Histogram, ZerosHaveNoBins) {
  const auto h = viewer::histogram_of(std::vector<float>(10, 0.0f));
  EXPECT_EQ(h.zeros, 10U);
  EXPECT_TRUE(h.counts.empty());
}

}  // namespace
}  // namespace etendue::sampling_test
