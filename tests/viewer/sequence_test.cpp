// The Sequence panel: numbered files of an animation or of a turntable.
#include "scripted.h"

namespace etendue::sequence_test {
namespace {

class Sequence : public Viewer {
 protected:
  // Asks for the files of a turntable.
  json turntable(int images, const std::string& files) const {
    return json::array({click("panel.sequence"), set("sequence.kind", "turntable"), set("sequence.images", images),
                        set("sequence.samples", 2), click("sequence.start"), set("files.name", path(files)),
                        click("files.accept")});
  }
};

TEST_F(Sequence, TurntableHasNumberedFilesThatStartWithTheView) {
  const auto steps = joined(small(2), joined(turntable(24, "turn.##.exr"),
                                             json::array({wait_for("sequence"), file_step("state", path("s.json")),
                                                          file_step("image", path("view.exr"))})));
  ASSERT_EQ(run(steps, "cornell"), 0);
  const json sequence = state("s.json")["sequence"];
  EXPECT_EQ(sequence["done"], 24);
  EXPECT_EQ(sequence["file"], path("turn.23.exr"));
  EXPECT_EQ(sequence["error"], "");
  const auto pixels = [&](const char* file) { return saved_image(file).find("")->pixels; };
  EXPECT_EQ(pixels("turn.00.exr"), pixels("view.exr"));
  EXPECT_NE(pixels("turn.01.exr"), pixels("turn.00.exr"));
  EXPECT_NE(pixels("turn.23.exr"), pixels("turn.01.exr"));
  EXPECT_FALSE(fs::exists(path("turn.24.exr")));
}

TEST_F(Sequence, FilesThatExistAreReplacedOnlyOnRequest) {
  std::ofstream(path("turn.01.png")) << "kept";
  const auto start =
      joined(small(2), joined(turntable(2, "turn.##.png"),
                              json::array({wait_for("sequence"), file_step("state", path("refused.json"))})));
  ASSERT_EQ(run(start, "cornell"), 0);
  const json errors = state("refused.json")["errors"];
  ASSERT_EQ(errors.size(), 1U) << errors;
  EXPECT_NE(errors[0].get<std::string>().find("turn.01.png exists"), std::string::npos) << errors;
  EXPECT_EQ(fs::file_size(path("turn.01.png")), 4U);
  EXPECT_FALSE(fs::exists(path("turn.00.png")));

  json replacing = joined(small(2), json::array({click("panel.sequence"), set("sequence.replace", true)}));
  replacing = joined(replacing, turntable(2, "turn.##.png"));
  ASSERT_EQ(run(joined(replacing, json::array({wait_for("sequence")})), "cornell"), 0);
  EXPECT_TRUE(fs::exists(path("turn.00.png")));
  EXPECT_GT(fs::file_size(path("turn.01.png")), 4U);
}

TEST_F(Sequence, StoppingKeepsCompleteImagesAndContinuesTheRendering) {
  const auto steps =
      joined(small(4), joined(turntable(5000, "turn.####.png"), json::array({{{"do", "wait"}, {"seconds", 1.5}},
                                                                             click("sequence.stop"),
                                                                             file_step("state", path("stopped.json")),
                                                                             set("render.samples", 8),
                                                                             wait_for("limit"),
                                                                             file_step("state", path("after.json"))})));
  ASSERT_EQ(run(steps, "cornell"), 0);
  const json stopped = state("stopped.json")["sequence"];
  EXPECT_EQ(stopped["running"], false);
  EXPECT_LT(stopped["done"], 5000);
  EXPECT_EQ(state("after.json")["samples"], 8);
  EXPECT_FALSE(fs::exists(path("turn.4999.png")));
}

TEST_F(Sequence, AFullDiskEndsTheSequence) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  fs::create_symlink("/dev/full", path("turn.01.png"));
  json steps = joined(small(2), json::array({click("panel.sequence"), set("sequence.replace", true)}));
  steps = joined(steps, turntable(3, "turn.##.png"));
  steps = joined(steps, json::array({wait_for("sequence"), file_step("state", path("s.json"))}));
  ASSERT_EQ(run(steps, "cornell"), 0);
  const json report = state("s.json");
  EXPECT_EQ(report["sequence"]["done"], 1);
  EXPECT_NE(report["sequence"]["error"].get<std::string>().find("turn.01.png"), std::string::npos)
      << report["sequence"];
  EXPECT_TRUE(fs::exists(path("turn.00.png")));
  EXPECT_FALSE(fs::exists(path("turn.02.png")));
  EXPECT_EQ(report["errors"].size(), 1U) << report["errors"];
}

TEST_F(Sequence, AnimationHasTheFramesOfTheRange) {
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  if (!data) GTEST_SKIP() << "ETENDUE_TEST_DATA is not set";
  const std::string file = std::string(data) + "/gltf/Fox.glb";
  if (!fs::exists(file)) GTEST_SKIP() << file << " is missing";
  const auto steps = joined(small(1), json::array({key("."),
                                                   click("animation.range-start"),
                                                   key("."),
                                                   click("animation.range-end"),
                                                   key("."),  // the first frame follows the last one
                                                   file_step("state", path("range.json")),
                                                   key("p"),
                                                   {{"do", "wait"}, {"seconds", 0.7}},  // several turns of the range
                                                   key("p"),
                                                   file_step("state", path("played.json")),
                                                   click("panel.sequence"),
                                                   set("sequence.samples", 1),
                                                   click("sequence.start"),
                                                   set("files.name", path("fox.png")),
                                                   click("files.accept"),
                                                   wait_for("sequence"),
                                                   click("animation.clear-range"),
                                                   file_step("state", path("cleared.json"))}));
  ASSERT_EQ(run(steps, file, 1280, 720), 0);
  const json range = state("range.json"), cleared = state("cleared.json");
  EXPECT_NEAR(range["parameters"]["scene.time"].get<double>(), 1.0 / 24, 1e-6);
  EXPECT_EQ(range["sequence"]["first"], 1);
  EXPECT_EQ(range["sequence"]["end"], 3);
  EXPECT_EQ(range["edited"], false);
  const double played = state("played.json")["parameters"]["scene.time"];
  EXPECT_GE(played, 1.0 / 24 - 1e-6);
  EXPECT_LT(played, 3.0 / 24);
  EXPECT_TRUE(fs::exists(path("fox.0001.png")));
  EXPECT_TRUE(fs::exists(path("fox.0002.png")));
  EXPECT_FALSE(fs::exists(path("fox.0000.png")));
  EXPECT_FALSE(fs::exists(path("fox.0003.png")));
  EXPECT_EQ(cleared["sequence"]["first"], 0);
  EXPECT_GT(cleared["sequence"]["end"], 3);
}

}  // namespace
}  // namespace etendue::sequence_test
