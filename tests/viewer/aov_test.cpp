// AOVs in the viewport: the terms of the equation of transfer.
#include <cmath>

#include "scripted.h"

namespace etendue::aov_test {
namespace {

class AovInViewport : public Viewer {};

// The image is surface - absorption - out-scattering + emission + in-scattering. Each term has its own few samples, so
// the means over the image are compared.
TEST_F(AovInViewport, TermsOfMediaSumToTheImage) {
  json steps = joined(small(16), json::array({file_step("image", path("image.exr"))}));
  const std::string terms[] = {"medium-surface", "medium-absorption", "medium-out-scattering", "medium-emission",
                               "medium-in-scattering"};
  for (const std::string& term : terms) {
    steps.push_back(set("view.aov", term));
    steps.push_back({{"do", "wait"}, {"for", "aov"}});
    steps.push_back(file_step("state", path(term + ".json")));
  }
  ASSERT_EQ(run(steps, "fog"), 0);
  const auto mean = [&](const std::string& term) {
    const json aov = state(term + ".json")["aov"];
    EXPECT_EQ(aov["name"], term);
    return aov["mean_luminance"].get<double>();
  };
  const double sum = mean(terms[0]) - mean(terms[1]) - mean(terms[2]) + mean(terms[3]) + mean(terms[4]);
  const auto image = saved_image("image.exr");
  const auto& pixels = image.layers.at(0).pixels;
  double expected = 0;
  for (size_t i = 0; i + 2 < pixels.size(); i += 3)
    expected += 0.2126 * double{pixels[i]} + 0.7152 * double{pixels[i + 1]} + 0.0722 * double{pixels[i + 2]};
  expected /= static_cast<double>(pixels.size()) / 3;
  EXPECT_NEAR(sum, expected, 0.2 * expected);
  EXPECT_GT(mean(terms[4]), 0.05 * expected);
  EXPECT_GT(mean(terms[2]), 0.02 * expected);
}

// Layers of light paths, each with its own few samples.
TEST_F(AovInViewport, BouncesSumToTheImage) {
  json steps = joined(small(16), json::array({file_step("image", path("image.exr"))}));
  const std::string layers[] = {"emission", "direct", "indirect"};
  for (const std::string& layer : layers) {
    steps.push_back(set("view.aov", layer));
    steps.push_back({{"do", "wait"}, {"for", "aov"}});
    steps.push_back(file_step("state", path(layer + ".json")));
  }
  ASSERT_EQ(run(steps, "cornell"), 0);
  double sum = 0;
  for (const std::string& layer : layers) {
    const json aov = state(layer + ".json")["aov"];
    EXPECT_EQ(aov["name"], layer);
    EXPECT_GT(aov["mean_luminance"].get<double>(), 0) << layer;
    sum += aov["mean_luminance"].get<double>();
  }
  const auto image = saved_image("image.exr");
  const auto& pixels = image.layers.at(0).pixels;
  double expected = 0;
  for (size_t i = 0; i + 2 < pixels.size(); i += 3)
    expected += 0.2126 * double{pixels[i]} + 0.7152 * double{pixels[i + 1]} + 0.0722 * double{pixels[i + 2]};
  expected /= static_cast<double>(pixels.size()) / 3;
  EXPECT_NEAR(sum, expected, 0.2 * expected);
}

// The importance is that of the view when the layer was chosen: seen from the side, the same places are bright. Choosing it
// again makes it that of the new view.
TEST_F(AovInViewport, ImportanceKeepsTheCameraForWhichItWasChosen) {
  json steps = small(1);
  const auto show = [&](const char* report) {
    steps.push_back(set("view.aov", "importance"));
    steps.push_back(wait_for("aov"));
    steps.push_back(file_step("state", path(report)));
  };
  show("front.json");
  steps.push_back(set("camera.eye.x", 0.8));
  show("side.json");
  steps.push_back(set("view.aov", "picture"));
  show("again.json");
  ASSERT_EQ(run(steps, "cornell"), 0);
  const auto mean_of = [&](const char* report) {
    const json aov = state(report)["aov"];
    EXPECT_EQ(aov["name"], "importance");
    return aov["mean_luminance"].get<double>();
  };
  const double front = mean_of("front.json"), side = mean_of("side.json"), again = mean_of("again.json");
  EXPECT_NE(side, front) << "another view of the same importance";
  EXPECT_NE(again, side) << "the importance of the new view";
}

// A scene without media has no such terms.
TEST_F(AovInViewport, TermsOfMediaAreForScenesWithMedia) {
  EXPECT_EQ(run(joined(small(1), json::array({set("view.aov", "medium-surface")})), "cornell"), 1);
  EXPECT_EQ(
      run(joined(small(1), json::array({set("view.aov", "albedo"), {{"do", "wait"}, {"for", "aov"}}})), "cornell"), 0);
}

// The denoised image has the brightness of the image within its bias. It is shown instead of the image, but never
// exported instead of it.
TEST_F(AovInViewport, DenoisedImageIsOnlyDisplayed) {
  json steps =
      joined(small(16), json::array({file_step("image", path("before.exr")), key("shift+v"), wait_for("aov"),
                                     file_step("state", path("denoised.json")), file_step("image", path("after.exr")),
                                     key("shift+v"), file_step("state", path("image.json"))}));
  ASSERT_EQ(run(steps, "cornell"), 0);
  const json aov = state("denoised.json")["aov"];
  EXPECT_EQ(aov["name"], "denoised");
  EXPECT_EQ(aov["samples"], 16);
  EXPECT_TRUE(state("image.json")["aov"].is_null());
  const auto before = saved_image("before.exr"), after = saved_image("after.exr");
  const auto& pixels = before.layers.at(0).pixels;
  EXPECT_EQ(pixels, after.layers.at(0).pixels);
  double expected = 0;
  for (size_t i = 0; i + 2 < pixels.size(); i += 3)
    expected += 0.2126 * double{pixels[i]} + 0.7152 * double{pixels[i + 1]} + 0.0722 * double{pixels[i + 2]};
  expected /= static_cast<double>(pixels.size()) / 3;
  const double mean = aov["mean_luminance"].get<double>();
  EXPECT_NEAR(mean, expected, 0.05 * expected);
  EXPECT_NE(mean, expected);
}

}  // namespace
}  // namespace etendue::aov_test
