// Pan and zoom of the image: neither the camera nor the rendering changes.
#include "scripted.h"

namespace etendue::zoom_test {
namespace {

json hold(const std::string& name, bool down) { return {{"do", "key"}, {"key", name}, {"down", down}}; }

TEST_F(Viewer, ZoomKeepsDocumentAndSamples) {
  const auto steps =
      joined(small(), json::array({file_step("state", path("before.json")),
                                   file_step("image", path("before.exr")),
                                   key("ctrl+2"),
                                   file_step("state", path("double.json")),
                                   hold("ctrl", true),
                                   {{"do", "scroll"}, {"at", {200, 200}}, {"by", 3}},
                                   hold("ctrl", false),
                                   file_step("state", path("wheel.json")),
                                   {{"do", "drag"}, {"from", {300, 300}}, {"to", {200, 250}}, {"button", "middle"}},
                                   file_step("state", path("moved.json")),
                                   {{"do", "wait"}, {"spp", 4}},
                                   file_step("image", path("after.exr")),
                                   key("ctrl+0"),
                                   file_step("state", path("fitted.json"))}));
  ASSERT_EQ(run(steps), 0);
  for (const char* name : {"double.json", "wheel.json", "moved.json", "fitted.json"}) {
    EXPECT_EQ(state(name)["parameters"], state("before.json")["parameters"]) << name;
    EXPECT_EQ(state(name)["undo_depth"], state("before.json")["undo_depth"]) << name;
    EXPECT_EQ(state(name)["samples"], 4) << name;
  }
  EXPECT_EQ(state("double.json")["zoom"], 2);
  EXPECT_EQ(state("double.json")["image"][2], 2 * 96);
  EXPECT_NEAR(state("wheel.json")["zoom"].get<double>(), 2 * 1.25 * 1.25 * 1.25, 1e-5);
  EXPECT_EQ(state("fitted.json")["zoom"], 0);
  EXPECT_EQ(state("fitted.json")["image"], state("before.json")["image"]);
  const auto before = saved_image("before.exr"), after = saved_image("after.exr");
  EXPECT_EQ(before.find("")->pixels, after.find("")->pixels);
}

TEST_F(Viewer, WheelZoomKeepsThePointUnderThePointer) {
  const Vec2 pointer(300, 250);
  const json scroll{{"do", "scroll"}, {"at", {pointer.x, pointer.y}}, {"by", 4}};
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             key("ctrl+2"),
                             file_step("state", path("a.json")),
                             hold("ctrl", true),
                             scroll,
                             hold("ctrl", false),
                             file_step("state", path("b.json"))})),
            0);
  const auto relative = [&](const char* name) {
    const json image = state(name)["image"];
    return Vec2((pointer.x - image[0].get<float>()) / image[2].get<float>(),
                (pointer.y - image[1].get<float>()) / image[3].get<float>());
  };
  const Vec2 before = relative("a.json"), after = relative("b.json");
  const float pixel = 1 / state("b.json")["image"][2].get<float>();
  EXPECT_NEAR(before.x, after.x, 2 * pixel);
  EXPECT_NEAR(before.y, after.y, 2 * pixel);
}

TEST_F(Viewer, PickingFollowsTheZoom) {
  // A click on a point of the image selects the same object, wherever the zoom shows that point.
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             {{"do", "pick"}, {"at", {270, 95}}},
                             file_step("state", path("fitted.json")),
                             key("escape"),
                             hold("ctrl", true),
                             {{"do", "scroll"}, {"at", {270, 95}}, {"by", 5}},
                             hold("ctrl", false),
                             {{"do", "pick"}, {"at", {270, 95}}},
                             file_step("state", path("zoomed.json"))})),
            0);
  EXPECT_EQ(state("fitted.json")["selection"]["node"], state("zoomed.json")["selection"]["node"]);
}

}  // namespace
}  // namespace etendue::zoom_test
