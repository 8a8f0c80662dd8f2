// A fixture that runs the off-screen viewer with a script. Each test has its own folder for files.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "image/image.h"
#include "viewer/viewer.h"

namespace etendue {

using nlohmann::json;
namespace fs = std::filesystem;

class Viewer : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("etendue-viewer-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override {
    if (!HasFailure()) fs::remove_all(folder_);
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  int run(const json& steps, const std::string& scene = "", int width = 900, int height = 560) {
    std::ofstream(path("script.json")) << steps.dump();
    viewer::ViewOptions options;
    options.scene = scene;
    options.offscreen = true;
    options.script = path("script.json");
    options.width = width;
    options.height = height;
    return viewer::run_viewer(options);
  }

  json state(const std::string& name) const {
    std::ifstream in(path(name));
    return json::parse(in);
  }

  image::LayeredImage saved_image(const std::string& name) const {
    auto read = image::read_exr(path(name));
    EXPECT_TRUE(read) << read.error().message;
    return read ? *read : image::LayeredImage{};
  }

  // Small images with a sample limit, so that they can be compared bit by bit.
  static json small(int samples = 4) {
    return json::array({{{"do", "set"},
                         {"name", "render.samples"},
                         {"value", samples}},  // first, so that no rendered samples are discarded
                        {{"do", "set"}, {"name", "film.width"}, {"value", 96}},
                        {{"do", "set"}, {"name", "film.height"}, {"value", 96}},
                        {{"do", "wait"}, {"spp", samples}}});
  }

  static json joined(json a, const json& b) {
    for (const auto& step : b) a.push_back(step);
    return a;
  }

  fs::path folder_;
};

inline json set(const std::string& name, const json& value) {
  return {{"do", "set"}, {"name", name}, {"value", value}};
}
inline json click(const std::string& item) { return {{"do", "click"}, {"item", item}}; }
inline json key(const std::string& chord) { return {{"do", "key"}, {"key", chord}}; }
inline json wait_for(const char* what) { return {{"do", "wait"}, {"for", what}}; }
inline json file_step(const std::string& action, const std::string& file) { return {{"do", action}, {"file", file}}; }

}  // namespace etendue
