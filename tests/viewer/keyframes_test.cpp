// Keyframes of objects: set, move with handles, play, undo, and reopen.
#include "scripted.h"

namespace etendue::keyframes_test {
namespace {

class Keyframes : public Viewer {
 protected:
  // A box that is selected and has a keyframe at 0 s.
  static json with_key() {
    return joined(
        small(), json::array({click("add.box"), {{"do", "wait"}, {"spp", 1}}, key("k"), {{"do", "wait"}, {"spp", 1}}}));
  }
  static json at_time(double time) { return json::array({set("scene.time", time), {{"do", "wait"}, {"spp", 1}}}); }
  static json drag_x() { return {{"do", "drag"}, {"item", "gizmo.x"}, {"by", {-40, 3}}}; }
  json image(const char* name) const {
    return json::array({{{"do", "wait"}, {"spp", 4}}, file_step("image", path(name))});
  }

  bool same_image(const char* a, const char* b) const {
    return saved_image(a).find("")->pixels == saved_image(b).find("")->pixels;
  }
};

TEST_F(Keyframes, HandlesMoveTheObjectAtThePresentTime) {
  json steps = joined(with_key(), image("start.exr"));
  steps =
      joined(joined(steps, at_time(2)),
             json::array({key("g"), {{"do", "wait"}, {"spp", 1}}, drag_x(), file_step("state", path("moved.json"))}));
  steps = joined(joined(steps, image("end.exr")), joined(at_time(1), image("middle.exr")));
  steps = joined(joined(steps, joined(at_time(0), image("again.exr"))),
                 json::array({file_step("image", path("scene.exr"))}));
  ASSERT_EQ(run(steps, "cornell", 1280, 720), 0);
  EXPECT_EQ(state("moved.json")["undo"], "Move box");
  EXPECT_TRUE(same_image("start.exr", "again.exr"));
  EXPECT_FALSE(same_image("start.exr", "end.exr"));
  EXPECT_FALSE(same_image("start.exr", "middle.exr"));
  EXPECT_FALSE(same_image("middle.exr", "end.exr"));
  // Reopened, at another time.
  ASSERT_EQ(run(joined(at_time(2), image("reopened.exr")), path("scene.exr"), 1280, 720), 0);
  EXPECT_TRUE(same_image("end.exr", "reopened.exr"));
}

TEST_F(Keyframes, EachKeyAndEachDragIsOneStepOfUndo) {
  json steps = joined(with_key(), json::array({file_step("state", path("one.json"))}));
  steps = joined(joined(steps, at_time(2)), json::array({key("g"),
                                                         {{"do", "wait"}, {"spp", 1}},
                                                         file_step("state", path("before.json")),
                                                         drag_x(),
                                                         file_step("state", path("two.json")),
                                                         key("ctrl+z"),
                                                         file_step("state", path("undone.json")),
                                                         click("keyframe.remove")}));
  // There is no keyframe at 2 s any more, so the last step fails.
  testing::internal::CaptureStderr();
  EXPECT_NE(run(steps, "cornell", 1280, 720), 0);
  const std::string errors = testing::internal::GetCapturedStderr();
  EXPECT_NE(errors.find("disabled"), std::string::npos) << errors;
  EXPECT_EQ(state("one.json")["undo"], "Set keyframe of box");
  EXPECT_EQ(state("two.json")["undo_depth"], state("before.json")["undo_depth"].get<int>() + 1);
  EXPECT_EQ(state("undone.json")["undo_depth"], state("before.json")["undo_depth"]);
}

TEST_F(Keyframes, RemovingTheOnlyOneEndsTheAnimation) {
  const json steps = joined(with_key(), json::array({click("keyframe.remove"),
                                                     {{"do", "wait"}, {"spp", 1}},
                                                     file_step("state", path("removed.json")),
                                                     key("g"),
                                                     {{"do", "wait"}, {"spp", 1}},
                                                     drag_x(),
                                                     file_step("state", path("moved.json"))}));
  ASSERT_EQ(run(steps, "cornell", 1280, 720), 0);
  EXPECT_EQ(state("removed.json")["undo"], "Remove keyframe of box");
  // Without keyframes, handles move the object itself.
  const json a = state("removed.json")["parameters"], b = state("moved.json")["parameters"];
  const std::string x =
      "node." + std::to_string(state("moved.json")["selection"]["node"].get<int>()) + ".translation.x";
  EXPECT_NE(a[x], b[x]);
}

TEST_F(Keyframes, ObjectsOfSkinsAreRefused) {
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  const std::string file = std::string(data ? data : "") + "/gltf/Fox.glb";
  if (!data || !fs::exists(file)) GTEST_SKIP() << "Fox.glb is missing";
  const auto steps = json::array({{{"do", "wait"}, {"spp", 1}},
                                  {{"do", "click"}, {"image", {0.5, 0.5}}},
                                  key("k"),
                                  file_step("state", path("s.json"))});
  ASSERT_EQ(run(steps, file, 1280, 720), 0);
  const json errors = state("s.json")["errors"];
  ASSERT_EQ(errors.size(), 1U) << errors;
  EXPECT_NE(errors[0].get<std::string>().find("joints"), std::string::npos) << errors;
}

}  // namespace
}  // namespace etendue::keyframes_test
