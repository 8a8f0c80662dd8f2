// A fixture for tests that write small glTF files and load them.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scene/gltf/load_gltf.h"
#include "unit/scene/gltf_document.h"

namespace etendue::test {

// Each test has its own folder.
class GltfTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(info->test_suite_name()) + "." + info->name();
    std::replace(name.begin(), name.end(), '/', '_');
    folder_ = std::filesystem::path(testing::TempDir()) / ("etendue-" + name);
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }

  Result<scene::Scene> load(Gltf& gltf, const scene::LoadOptions& options = {}) const {
    return scene::load_gltf(write("test.glb", gltf.glb()), options);
  }

  // Loads a file that must be valid.
  scene::Scene opened(Gltf& gltf) const {
    auto scene = load(gltf);
    if (scene) return std::move(*scene);
    ADD_FAILURE() << scene.error().message;
    return {};
  }
  static std::shared_ptr<const Mesh> mesh_of(const scene::Scene& scene, size_t primitive = 0) {
    if (!scene.meshes.empty() && primitive < scene.meshes[0].primitives.size())
      return scene.meshes[0].primitives[primitive].mesh;
    ADD_FAILURE() << "there is no such primitive";
    return std::make_shared<Mesh>();
  }

  // The error message without the file name; empty if the file loads.
  std::string error_of(Gltf& gltf) const { return stripped(load(gltf)); }
  std::string error_of(const std::string& content) const {
    return stripped(scene::load_gltf(write("test.gltf", content)));
  }
  std::string stripped(const Result<scene::Scene>& result) const {
    if (result) return "";
    EXPECT_EQ(result.error().fault, Fault::input);
    const std::string& message = result.error().message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    const size_t name = message.find(": ");
    EXPECT_TRUE(message.starts_with(folder_.string())) << message;
    return message.substr(name + 2);
  }

  static bool warns(const scene::Scene& scene, const std::string& text) {
    for (const std::string& warning : scene.warnings)
      if (warning.find(text) != std::string::npos) return true;
    return false;
  }
  static std::string all(const std::vector<std::string>& lines) {
    std::string text;
    for (const auto& line : lines) text += line + "\n";
    return text;
  }

  std::filesystem::path folder_;
};

}  // namespace etendue::test
