// Comparison of images: the split view, the difference, FLIP and the reference.
#include "viewer/viewport/comparison.h"

#include <cmath>

#include "image/display.h"
#include "scripted.h"
#include "spectrum/colormap.h"

namespace etendue::comparison_test {
namespace {

constexpr int kWidth = 400, kHeight = 300;  // a dialog has room in it

// Equal images, and differences whose mean is small, are not shown as "+0".
TEST(DifferenceText, ShowsSignAndDigits) {
  using viewer::CompareMode, viewer::make_difference_map;
  const auto image = [](float value) { return std::make_shared<const std::vector<Rgb>>(16, Rgb(value)); };
  const auto text = [&](float left, float right) {
    return viewer::difference_text(
        *make_difference_map({.mode = CompareMode::difference, .left = image(left), .right = image(right)}, 4, 4));
  };
  EXPECT_EQ(text(1, 1), "equal");
  EXPECT_EQ(text(1, 1 - 1e-6f).substr(0, 8), "mean +9.");
  EXPECT_EQ(text(0.5f, 1).substr(0, 9), "mean -0.5");
  auto mixed = std::vector<Rgb>(16, Rgb(1));
  mixed[0] = Rgb(2);
  mixed[1] = Rgb(0);
  const viewer::DifferenceInput input{
      .mode = CompareMode::difference, .left = std::make_shared<const std::vector<Rgb>>(mixed), .right = image(1)};
  EXPECT_EQ(viewer::difference_text(*make_difference_map(input, 4, 4)), "mean 0, RMS 0.3536");
}

TEST(ComparisonProblem, AMissingImageIsNotCompared) {
  viewer::Comparison comparison([] {});
  const auto frame = std::make_shared<render::Frame>();
  comparison.mode = viewer::CompareMode::difference;
  comparison.live = {.name = "a", .label = "a", .frame = frame};
  comparison.pin();
  EXPECT_TRUE(comparison.is_active());
  comparison.live.unavailable = "no light can reach a pinhole";
  EXPECT_FALSE(comparison.is_active());
  EXPECT_EQ(comparison.problem(), "A: n/a. a: no light can reach a pinhole");
  comparison.live.unavailable.clear();
  comparison.a = {.name = "light-pure",
                  .label = "Pure light tracing",
                  .frame = nullptr,
                  .unavailable = "no light can reach a pinhole"};
  EXPECT_EQ(comparison.first().name, "light-pure") << "the live image does not stand in for it";
  EXPECT_EQ(comparison.problem(), "A: n/a. Pure light tracing: no light can reach a pinhole");
  comparison.a.label = "Pure light tracing, Halton";
  comparison.a.unavailable = "Pure light tracing: no light can reach a pinhole";
  EXPECT_EQ(comparison.problem(), "A: n/a. Pure light tracing: no light can reach a pinhole");
}

// Hides the interface and makes a screenshot.
json bare_shot(const std::string& file) { return json::array({key("h"), file_step("screenshot", file), key("h")}); }

// The displayed bytes of the beauty layer of an image.
std::vector<uint8_t> encoded(const image::LayeredImage& saved) {
  return image::display_pixels(saved.find("")->pixels, 0, image::ToneCurve::none);
}

// Bytes of a window of the size of the image.
struct Shot {
  std::vector<uint8_t> bytes;
  int at(int x, int y, int c) const { return bytes[3 * static_cast<size_t>(y * kWidth + x) + static_cast<size_t>(c)]; }
};

class ComparisonView : public Viewer {
 protected:
  // In a window of the size of the image, without the interface, screen pixels are image pixels.
  Shot shot(const std::string& name) const {
    const auto read = image::read_linear(path(name));
    EXPECT_TRUE(read) << read.error().message;
    Shot s;
    if (read)
      for (const float v : read->find("")->pixels)
        s.bytes.push_back(static_cast<uint8_t>(std::lround(255 * linear_to_srgb(v))));
    EXPECT_EQ(s.bytes.size(), size_t{3} * kWidth * kHeight);
    s.bytes.resize(size_t{3} * kWidth * kHeight);
    return s;
  }

  int run_small(const json& steps, const std::string& scene = "") { return run(steps, scene, kWidth, kHeight); }

  // Two images in files, with different light: a scene to open and an image to compare it with.
  void make_two() {
    const json steps = joined(small(), json::array({set("film.width", kWidth),
                                                    set("film.height", kHeight),
                                                    {{"do", "wait"}, {"spp", 4}},
                                                    file_step("image", path("first.exr")),
                                                    set("material.2.base-color.g", 0.9),
                                                    set("render.integrator", "path-pure"),
                                                    {{"do", "wait"}, {"spp", 4}},
                                                    file_step("image", path("second.exr"))}));
    ASSERT_EQ(run(steps), 0);
  }

  // The number of pixels in the columns [first, end) that differ from the expected bytes. Rows near the top and the
  // bottom are skipped because labels and notices cover them.
  static int wrong_pixels(const Shot& seen, const std::vector<uint8_t>& expected, int first, int end) {
    int wrong = 0;
    for (int y = kHeight / 5; y < kHeight * 3 / 5; ++y)
      for (int x = first; x < end; ++x) {
        bool same = true;
        for (int c = 0; c < 3; ++c)
          same = same && std::abs(seen.at(x, y, c) -
                                  expected[3 * static_cast<size_t>(y * kWidth + x) + static_cast<size_t>(c)]) <= 1;
        wrong += same ? 0 : 1;
      }
    return wrong;
  }
};

const json kWaitForWork = {{"do", "wait"}, {"for", "comparison"}};

TEST_F(ComparisonView, SplitShowsALeftAndBRightOfTheDivider) {
  make_two();
  json steps = json::array({{{"do", "wait"}, {"spp", 4}},
                            click("compare.load-b"),
                            click("files.second.exr"),
                            click("files.accept"),
                            kWaitForWork,
                            file_step("state", path("a.json"))});
  steps = joined(joined(steps, bare_shot(path("wipe.png"))), json::array({click("compare.swap")}));
  steps = joined(steps, bare_shot(path("swapped.png")));
  ASSERT_EQ(run_small(steps, path("first.exr")), 0);
  EXPECT_EQ(state("a.json")["comparison"]["mode"], "wipe");
  EXPECT_EQ(state("a.json")["comparison"]["b"], "second.exr");
  EXPECT_EQ(state("a.json")["comparison"]["a"], "path, sobol, 4 spp");
  const auto a = encoded(saved_image("first.exr")), b = encoded(saved_image("second.exr"));
  const Shot wipe = shot("wipe.png"), swapped = shot("swapped.png");
  // The divider and its handle cover some columns in the middle.
  constexpr int kLine = 12;
  EXPECT_EQ(wrong_pixels(wipe, a, 0, kWidth / 2 - kLine), 0);
  EXPECT_EQ(wrong_pixels(wipe, b, kWidth / 2 + kLine, kWidth), 0);
  EXPECT_EQ(wrong_pixels(swapped, b, 0, kWidth / 2 - kLine), 0);
  EXPECT_EQ(wrong_pixels(swapped, a, kWidth / 2 + kLine, kWidth), 0);
  // The images differ enough for the test to distinguish them.
  EXPECT_GT(wrong_pixels(wipe, b, 0, kWidth / 2 - kLine), 5000);
  EXPECT_GT(wrong_pixels(wipe, a, kWidth / 2 + kLine, kWidth), 5000);
}

TEST_F(ComparisonView, PinnedImageStaysWhileTheSceneIsEdited) {
  const json steps = joined(small(), json::array({click("compare.pin"),
                                                  set("render.integrator", "path-pure"),
                                                  {{"do", "wait"}, {"spp", 4}},
                                                  click("compare.difference"),
                                                  kWaitForWork,
                                                  file_step("state", path("a.json")),
                                                  key("c"),
                                                  {{"do", "drag"}, {"item", "compare.divider"}, {"by", {60, 0}}},
                                                  file_step("state", path("b.json")),
                                                  key("alt+left"),
                                                  file_step("state", path("c.json")),
                                                  key("c"),
                                                  file_step("state", path("d.json"))}));
  ASSERT_EQ(run(steps), 0);
  const json a = state("a.json")["comparison"];
  EXPECT_EQ(a["mode"], "difference");
  EXPECT_EQ(a["a"], "path-pure, sobol, 4 spp");
  EXPECT_EQ(a["b"], "path, sobol, 4 spp");
  EXPECT_GT(a["scale"].get<double>(), 0.01);
  const double moved = state("b.json")["comparison"]["divider"].get<double>();
  EXPECT_GT(moved, 0.55);
  EXPECT_EQ(state("b.json")["comparison"]["mode"], "wipe");
  EXPECT_EQ(state("b.json")["undo_depth"], state("a.json")["undo_depth"]) << "the drag went to the camera";
  EXPECT_NEAR(state("c.json")["comparison"]["divider"].get<double>(), moved - 0.01, 1e-5);
  EXPECT_EQ(state("d.json")["comparison"]["mode"], "off");
}

TEST_F(ComparisonView, EqualImagesHaveZeroDifferenceAndFlip) {
  json steps = joined(small(), json::array({click("compare.pin"), click("compare.difference"), kWaitForWork,
                                            file_step("state", path("a.json")), click("compare.flip"), kWaitForWork,
                                            file_step("state", path("b.json"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_EQ(state("a.json")["comparison"]["scale"], 0);
  EXPECT_EQ(state("a.json")["comparison"]["mean_difference"], 0);
  EXPECT_EQ(state("b.json")["comparison"]["flip"], 0);
  EXPECT_EQ(state("b.json")["comparison"]["fresh"], true);
}

TEST_F(ComparisonView, ReferenceIsShownWhileShiftIsHeld) {
  make_two();
  const auto shift = [](bool down) { return json{{"do", "key"}, {"key", "shift"}, {"down", down}}; };
  json steps = json::array({{{"do", "wait"}, {"spp", 4}},
                            click("compare.load-reference"),
                            click("files.second.exr"),
                            click("files.accept"),
                            kWaitForWork,
                            key("h"),
                            shift(true),
                            {{"do", "wait"}, {"seconds", 0.6}},
                            file_step("state", path("held.json")),
                            file_step("screenshot", path("held.png")),
                            shift(false),
                            {{"do", "wait"}, {"seconds", 0.2}},
                            file_step("screenshot", path("after.png")),
                            file_step("state", path("after.json"))});
  ASSERT_EQ(run_small(steps, path("first.exr")), 0);
  const auto on_screen = [&](const char* name) { return state(name)["comparison"]["reference_on_screen"].get<bool>(); };
  EXPECT_TRUE(on_screen("held.json"));
  EXPECT_FALSE(on_screen("after.json"));
  const auto a = encoded(saved_image("first.exr")), b = encoded(saved_image("second.exr"));
  EXPECT_EQ(wrong_pixels(shot("held.png"), b, 0, kWidth), 0);
  EXPECT_EQ(wrong_pixels(shot("after.png"), a, 0, kWidth), 0);
}

TEST_F(ComparisonView, ImageOfAnotherSizeIsRefusedWithAMessage) {
  make_two();
  json steps = json::array({{{"do", "wait"}, {"spp", 4}},
                            click("compare.load-b"),
                            click("files.second.exr"),
                            click("files.accept"),
                            kWaitForWork,
                            set("film.width", 64),
                            {{"do", "wait"}, {"spp", 4}},
                            file_step("state", path("a.json"))});
  ASSERT_EQ(run(steps, path("first.exr")), 0);
  const auto problem = state("a.json")["comparison"]["problem"].get<std::string>();
  EXPECT_NE(problem.find("64 x 300"), std::string::npos) << problem;
  EXPECT_NE(problem.find("400 x 300"), std::string::npos) << problem;
}

std::shared_ptr<const render::Frame> frame() {
  auto made = std::make_shared<render::Frame>();
  made->width = made->height = 1;
  made->pixels = std::make_shared<const std::vector<Rgb>>(1);
  return made;
}

TEST(Comparison, ShiftActsAloneAndAfterADelay) {
  using namespace std::chrono_literals;
  constexpr size_t kShift = 340, kControl = 341;  // as GLFW numbers them
  const viewer::Comparison::Clock::time_point start{};
  viewer::Input held, with_control, with_button, none;
  held.keys[kShift] = with_control.keys[kShift] = with_button.keys[kShift] = true;
  with_control.keys[kControl] = true;
  with_button.buttons[0] = true;
  const auto shows = [&](const viewer::Input& later, bool typing, auto after) {
    viewer::Comparison c([] {});
    c.reference.frame = c.live.frame = frame();
    c.update_shift(held, typing, start);
    EXPECT_FALSE(c.reference_is_shown());
    c.update_shift(later, typing, start + after);
    return c.reference_is_shown();
  };
  EXPECT_TRUE(shows(held, false, 250ms));
  EXPECT_FALSE(shows(held, false, 100ms));
  EXPECT_FALSE(shows(with_control, false, 250ms));
  EXPECT_FALSE(shows(with_button, false, 250ms)) << "Shift with a button pans";
  EXPECT_FALSE(shows(held, true, 250ms)) << "Shift in a text field writes a capital";
  EXPECT_FALSE(shows(none, false, 250ms));
}

TEST(Comparison, FileIsAcceptedIfItHasTheSizeOfTheImage) {
  const auto file = fs::temp_directory_path() / "etendue-comparison.exr";
  const auto loaded = [&](int width) {
    image::LayeredImage pixels;
    pixels.width = width;
    pixels.height = 1;
    pixels.layers.push_back({"", {"R", "G", "B"}, std::vector<float>(3 * static_cast<size_t>(width), 0.5f)});
    EXPECT_TRUE(image::write_exr(file, pixels));
    viewer::Comparison c([] {});
    c.live.frame = frame();
    c.load(file.string(), viewer::Comparison::Target::b);
    std::optional<Result<std::string>> result;
    while (!result) result = c.take_load_result();
    EXPECT_EQ(static_cast<bool>(*result), c.b.frame != nullptr);
    return *result ? "" : result->error().message;
  };
  EXPECT_EQ(loaded(1), "");
  EXPECT_NE(loaded(2).find("is 2 x 1, the image is 1 x 1"), std::string::npos);
  fs::remove(file);
}

std::shared_ptr<const std::vector<Rgb>> flat(float value) {
  return std::make_shared<const std::vector<Rgb>>(32 * 32, Rgb(value));
}

TEST(DifferenceMap, SignIsLeftMinusRight) {
  const auto brighter =
      viewer::make_difference_map({viewer::CompareMode::difference, flat(0.75f), flat(0.5f), 0, {}}, 32, 32);
  EXPECT_NEAR(brighter->mean, 0.25, 1e-6);
  EXPECT_FLOAT_EQ(brighter->scale, 0.5f);
  EXPECT_GT(brighter->pixels[0].r, brighter->pixels[0].b);
  const auto darker =
      viewer::make_difference_map({viewer::CompareMode::difference, flat(0.5f), flat(0.75f), 0, {}}, 32, 32);
  EXPECT_NEAR(darker->mean, -0.25, 1e-6);
  EXPECT_GT(darker->pixels[0].b, darker->pixels[0].r);
}

TEST(DifferenceMap, OutliersDoNotSetTheScale) {
  auto pixels = std::vector<Rgb>(*flat(0.018f));
  for (size_t i = 0; i < 8; ++i) pixels[i] = Rgb(1e6f);
  pixels[8] = Rgb(NAN);
  const auto map = viewer::make_difference_map(
      {viewer::CompareMode::difference, std::make_shared<const std::vector<Rgb>>(pixels), flat(0), 0, {}}, 32, 32);
  EXPECT_FLOAT_EQ(map->scale, 0.02f);
}

TEST(DifferenceMap, FlipUsesTheDisplayedExposure) {
  const auto flip = [](float exposure) {
    return viewer::make_difference_map({viewer::CompareMode::flip, flat(2), flat(3), exposure, image::ToneCurve::none},
                                       32, 32)
        ->mean;
  };
  EXPECT_EQ(flip(0), 0);  // both are white
  EXPECT_GT(flip(-2), 0.01);
}

}  // namespace
}  // namespace etendue::comparison_test
