// `etendue save`: saved files can be opened, and errors are reported.
#include <nlohmann/json.hpp>

#include "integration/cli/cli.h"

namespace etendue::test::save_test {
namespace {

class Save : public Cli {
 protected:
  nlohmann::json inspected(const std::string& file) const {
    const Outcome r = run("inspect --json " + file);
    EXPECT_EQ(r.code, 0) << r.err;
    return nlohmann::json::parse(r.out);
  }
};

TEST_F(Save, BothFormatsCanBeOpened) {
  const auto before = inspected("cornell");
  for (const std::string file : {"box.glb", "box.gltf"}) {
    const Outcome r = run("save cornell -o " + file);
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out + r.err, "");
    const auto after = inspected(file);
    for (const char* member : {"triangles", "instances", "lights", "cameras", "warnings", "unsupported"})
      EXPECT_EQ(before[member], after[member]) << file << " " << member;
  }
  EXPECT_TRUE(fs::exists(folder_ / "box.bin"));
}

TEST_F(Save, ParametersAreSaved) {
  ASSERT_EQ(run("save cornell -o box.gltf --set material.0.roughness=0.25 --set camera.lens-radius=0.125").code, 0);
  const auto root = nlohmann::json::parse(slurp(folder_ / "box.gltf"));
  EXPECT_EQ(root["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"], 0.25);
  EXPECT_EQ(root["cameras"][0]["extensions"]["ETENDUE_transport"]["lensRadius"], 0.125);
}

TEST_F(Save, ErrorsAreReported) {
  expect_error("save cornell -o nowhere/box.glb", 4, "nowhere");
  expect_error("save cornell -o box.obj", 2, "the file name has to end in .glb or .gltf");
  expect_error("save none.glb -o box.glb", 3, "none.glb");
  expect_error("save cornell -o box.glb --set material.0.rough=1", 2, "the nearest name is");
  expect_error("save cornell -o box.glb --variant autumn", 2, "there is no variant 'autumn'");
  expect_error("save cornell", 2, "--output");
}

// The folder exists but is not writable. Because root can write anywhere, a folder with the name of the file is used.
TEST_F(Save, AFolderWithTheNameOfTheFileIsAnError) {
  fs::create_directories(folder_ / "box.glb");
  expect_error("save cornell -o box.glb", 4, "this is a folder");
}

}  // namespace
}  // namespace etendue::test::save_test
