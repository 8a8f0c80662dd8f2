// The exposure that suits the visible surfaces.
#include "render/automatic_exposure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/document.h"
#include "scene/compiled_scene.h"

namespace etendue::render {
namespace {

// 100 luminances from scale / 100 to scale, so that the 90th percentile is 0.91 times the scale.
std::vector<float> luminances(float scale) {
  std::vector<float> list;
  for (int i = 1; i <= 100; ++i) list.push_back(scale * static_cast<float>(i) / 100);
  return list;
}

TEST(AutomaticExposure, BringsThePercentileToItsTargetWithinAQuarterStop) {
  for (const float scale : {1e-6f, 0.01f, 0.6f, 7.0f, 1e5f}) {
    const auto exposure = automatic_exposure(luminances(scale));
    ASSERT_TRUE(exposure) << scale;
    EXPECT_EQ(2 * *exposure, std::round(2 * *exposure));
    EXPECT_NEAR(std::log2(0.91f * scale * std::exp2(*exposure)), std::log2(0.6f), 0.2501f) << scale;
    EXPECT_FALSE(exposure_is_unsuitable(luminances(scale), *exposure));
  }
}

TEST(AutomaticExposure, OnlyExtremesAreUnsuitable) {
  EXPECT_FALSE(exposure_is_unsuitable(luminances(0.2f), 0));
  EXPECT_FALSE(exposure_is_unsuitable(luminances(2), 0));
  EXPECT_TRUE(exposure_is_unsuitable(luminances(0.01f), 0));
  EXPECT_TRUE(exposure_is_unsuitable(luminances(20), 0));
  EXPECT_FALSE(exposure_is_unsuitable(luminances(20), -4));
}

TEST(AutomaticExposure, BlackImagesHaveNone) {
  EXPECT_FALSE(automatic_exposure({}));
  EXPECT_FALSE(automatic_exposure(std::vector<float>(50, 0.0f)));
  EXPECT_FALSE(automatic_exposure(std::vector<float>(50, INFINITY)));
}

TEST(AutomaticExposure, InvalidPixelsCountAsBlack) {
  Document document = *new_document("cornell");
  document.width = document.height = 96;
  const auto scene = scene::compile(document.scene, document.camera, nullptr);
  const auto visible = surface_luminances(document, *scene, std::vector<Rgb>(96 * 96, Rgb(NAN)));
  ASSERT_FALSE(visible.empty());
  EXPECT_EQ(visible.front(), 0);
  EXPECT_EQ(visible.back(), 0);
}

TEST(AutomaticExposure, LooksAtSurfacesOnly) {
  Document document = *new_document("glass-caustic");
  document.width = 96;
  document.height = 64;
  const auto scene = scene::compile(document.scene, document.camera, nullptr);
  const std::vector<Rgb> grey(96 * 64, Rgb(0.25f));
  const auto visible = surface_luminances(document, *scene, grey);
  ASSERT_FALSE(visible.empty());
  EXPECT_NEAR(visible.front(), 0.25f, 1e-6f);
  EXPECT_NEAR(visible.back(), 0.25f, 1e-6f);
  document.camera.to_world[3] += Vec4(0, 1e4f, 0, 0);
  EXPECT_LT(surface_luminances(document, *scene, grey).size(), visible.size());
}

}  // namespace
}  // namespace etendue::render
