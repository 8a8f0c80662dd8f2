// The safe areas of an image.
#include "viewer/viewport/safe_frames.h"

#include <gtest/gtest.h>

namespace etendue::viewer {
namespace {

TEST(SafeFrames, AreasAreCentredInTheImage) {
  const Placement image{.corner = {100, 50}, .size = {1000, 500}};
  const auto [action, title] = safe_areas(image);
  EXPECT_NEAR(action.size.x, 930, 1e-3);
  EXPECT_NEAR(action.size.y, 465, 1e-3);
  EXPECT_NEAR(title.size.x, 900, 1e-3);
  EXPECT_NEAR(title.size.y, 450, 1e-3);
  for (const Placement& area : {action, title}) {
    const Vec2 centre = area.corner + 0.5f * area.size;
    EXPECT_NEAR(centre.x, 600, 1e-3);
    EXPECT_NEAR(centre.y, 300, 1e-3);
  }
}

}  // namespace
}  // namespace etendue::viewer
