// The timeline: steps by frames, and the choice of a clip.
#include "scripted.h"

namespace etendue::timeline_test {
namespace {

TEST_F(Viewer, TimelineStepsByFramesAndChoosesClips) {
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  if (!data) GTEST_SKIP() << "ETENDUE_TEST_DATA is not set";
  const std::string file = std::string(data) + "/gltf/Fox.glb";
  if (!fs::exists(file)) GTEST_SKIP() << file << " is missing";
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             file_step("state", path("start.json")),
                             key("."),
                             key("."),
                             file_step("state", path("second.json")),
                             set("timeline.fps", "50"),
                             key(","),
                             file_step("state", path("fifty.json")),
                             set("scene.clip", "Run"),
                             {{"do", "wait"}, {"spp", 1}},
                             file_step("state", path("run.json")),
                             key("ctrl+z"),
                             file_step("state", path("undone.json"))}),
                file, 1280, 720),
            0);
  const auto parameter = [&](const char* report, const char* name) { return state(report)["parameters"][name]; };
  EXPECT_EQ(parameter("start.json", "scene.time"), 0);
  EXPECT_NEAR(parameter("second.json", "scene.time").get<double>(), 2.0 / 24, 1e-6);
  // 2 / 24 s is next to frame 4 of 50 per second.
  EXPECT_NEAR(parameter("fifty.json", "scene.time").get<double>(), 3.0 / 50, 1e-6);
  EXPECT_EQ(parameter("fifty.json", "scene.clip"), "all");
  EXPECT_EQ(parameter("run.json", "scene.clip"), "Run");
  EXPECT_EQ(parameter("undone.json", "scene.clip"), "all");
  EXPECT_EQ(state("run.json")["edited"], false);
}

}  // namespace
}  // namespace etendue::timeline_test
