// Without a display, the interface has the scale that it would have on a display of the size of the window.
#include "scripted.h"
#include "viewer/platform/display_scale.h"

namespace etendue::offscreen_scale_test {
namespace {

class OffscreenScale : public Viewer {};

TEST_F(OffscreenScale, FollowsTheHeight) {
  for (const auto& [height, scale] : {std::pair{720, 1.0}, {1349, 1.0}, {1440, 1.25}, {2160, 2.0}}) {
    EXPECT_EQ(static_cast<double>(viewer::scale_for_height(height)), scale) << height;
    ASSERT_EQ(run(json::array({file_step("state", path("state.json"))}), "cornell", 640, height), 0);
    EXPECT_EQ(state("state.json")["ui_scale"], scale) << height;
  }
}

}  // namespace
}  // namespace etendue::offscreen_scale_test
