// Files of the test data: valid ones open, invalid ones do not crash, and messages are one line.
#include <gtest/gtest.h>

#include <filesystem>

#include "scene/compiled_scene.h"
#include "scene/gltf/load_gltf.h"
#include "support/scenes.h"

namespace etendue {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> gltf_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class GltfData : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::data_folder();
    if (folder_.empty()) GTEST_SKIP() << "ETENDUE_TEST_DATA names no folder";
  }
  fs::path folder_;
};

// Files that need an unsupported extension or a later glTF version; the message names it.
bool names_what_is_missing(const std::string& message) {
  return message.find("requires the extension ") != std::string::npos ||
         message.find("requires glTF 2.1") != std::string::npos;
}

TEST_F(GltfData, ValidFilesOpenAndCompile) {
  int opened = 0;
  for (const auto& file : gltf_files(folder_ / "gltf")) {
    const auto scene = scene::load_gltf(file);
    if (!scene) {
      EXPECT_TRUE(names_what_is_missing(scene.error().message)) << scene.error().message;
      continue;
    }
    const auto camera = scene::choose_camera(*scene, "");
    ASSERT_TRUE(camera);
    const auto compiled = scene::compile(std::make_shared<const scene::Scene>(*scene), *camera, nullptr);
    EXPECT_EQ(compiled->triangle_count() > 0, !compiled->bounds().empty()) << file;
    ++opened;
  }
  EXPECT_GT(opened, 120);
}

TEST_F(GltfData, InvalidFilesAreRejectedOrRepairedInOneLine) {
  int refused = 0, seen = 0;
  for (const auto& file : gltf_files(folder_ / "gltf-invalid")) {
    ++seen;
    const auto scene = scene::load_gltf(file);
    if (scene) {
      const auto compiled = scene::compile(std::make_shared<const scene::Scene>(*scene), Camera{}, nullptr);
      EXPECT_TRUE(compiled);
      continue;
    }
    ++refused;
    const std::string& message = scene.error().message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(message.starts_with(file.string() + ": ")) << message;
  }
  EXPECT_GT(seen, 50);
  EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace etendue
