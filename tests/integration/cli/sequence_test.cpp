// `etendue render --frames` and `--turntable`.
#include <fstream>

#include "image/image.h"
#include "integration/cli/cli.h"

namespace etendue::test::sequence_test {
namespace {

class Sequence : public Cli {
 protected:
  std::vector<float> pixels(const std::string& file) const {
    const auto image = image::read_exr((folder_ / file).string());
    EXPECT_TRUE(image) << file;
    return image ? image->find("")->pixels : std::vector<float>();
  }
  std::vector<float> rendered(const std::string& arguments) const {
    EXPECT_EQ(run("render " + arguments + " -o single.exr").code, 0);
    return pixels("single.exr");
  }
};

// A triangle that moves by a metre to the right in a second, and a clip in which it moves up.
constexpr const char* kScene = R"({
  "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "animations": [
    {"name": "right", "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
     "samplers": [{"input": 1, "output": 2}]},
    {"name": "up", "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
     "samplers": [{"input": 1, "output": 3}]}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
    {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
    {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"},
    {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}],
  "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8},
    {"buffer": 0, "byteOffset": 44, "byteLength": 24}, {"buffer": 0, "byteOffset": 68, "byteLength": 24}],
  "buffers": [{"uri": "moving.bin", "byteLength": 92}]})";

void write_scene(const fs::path& folder) {
  const float numbers[23] = {0, 0, 0, 1, 0, 0, 0, 1, 0,  // positions
                             0, 1,                       // times
                             0, 0, 0, 1, 0, 0,           // to the right
                             0, 0, 0, 0, 1, 0};          // up
  std::ofstream(folder / "moving.gltf") << kScene;
  std::ofstream(folder / "moving.bin", std::ios::binary).write(reinterpret_cast<const char*>(numbers), sizeof numbers);
}

const std::string kMoving = "moving.gltf --spp 2 --size 32x24";

TEST_F(Sequence, FramesAreTheImagesAtTheirTimes) {
  write_scene(folder_);
  const Outcome r = run("render " + kMoving + " --frames 1:4 --fps 4 -o film.exr");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_FALSE(fs::exists(folder_ / "film.0000.exr"));
  EXPECT_FALSE(fs::exists(folder_ / "film.0004.exr"));
  EXPECT_EQ(pixels("film.0001.exr"), rendered(kMoving + " --set scene.time=0.25"));
  EXPECT_EQ(pixels("film.0003.exr"), rendered(kMoving + " --set scene.time=0.75"));
  EXPECT_NE(pixels("film.0001.exr"), pixels("film.0003.exr"));
}

TEST_F(Sequence, TheClipSelectsTheAnimation) {
  write_scene(folder_);
  const std::string late = kMoving + " --set scene.time=1";
  const auto all = rendered(late), right = rendered(late + " --set scene.clip=right"),
             up = rendered(late + " --set scene.clip=up");
  EXPECT_EQ(all, right);
  EXPECT_NE(all, up);
  // A clip is kept in the state of an image.
  ASSERT_EQ(run("render " + late + " --set scene.clip=up -o up.exr").code, 0);
  ASSERT_EQ(run("render --like up.exr -o again.exr").code, 0);
  EXPECT_EQ(pixels("again.exr"), up);
  expect_error("render " + kMoving + " --set scene.clip=down -o x.exr", 2, "down");
}

TEST_F(Sequence, TurntableBeginsWithTheViewOfTheCamera) {
  write_scene(folder_);
  ASSERT_EQ(run("render " + kMoving + " --turntable 3 -o turn-##.exr").code, 0);
  EXPECT_EQ(pixels("turn-00.exr"), rendered(kMoving));
  EXPECT_NE(pixels("turn-01.exr"), pixels("turn-00.exr"));
  EXPECT_NE(pixels("turn-02.exr"), pixels("turn-01.exr"));
  EXPECT_FALSE(fs::exists(folder_ / "turn-03.exr"));
}

TEST_F(Sequence, WrongArgumentsAreErrors) {
  expect_error("render cornell --frames 3:3 -o x.exr", 2, "range of frames");
  expect_error("render cornell --frames 2 --turntable 2 -o x.exr", 2, "exclude each other");
  expect_error("render cornell --frames 2 --samples 0:4 -o x.exr", 2, "whole images");
  expect_error("render cornell --frames 2 --json - -o x.exr", 2, "--json");
  expect_error("render cornell --fps 2 -o x.exr", 2, "--frames");
  expect_error("render cornell --turntable 2 -o nowhere/x.exr", 4, "nowhere");
}

}  // namespace
}  // namespace etendue::test::sequence_test
