// The picture of a scene while its textures are being read.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <optional>
#include <thread>

#include "scene/gltf/load_gltf.h"
#include "support/textured_gltf.h"
#include "viewer/files/loader.h"

namespace etendue::loading_picture_test {
namespace {

namespace fs = std::filesystem;

class LoadingPicture : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string written(int squares, int size) const {
    const fs::path file = folder_ / "squares.gltf";
    test::write_textured_gltf(file, squares, size);
    return file.string();
  }

  // Calls `wait` until the file is open, for at most a minute.
  template <class Wait>
  static std::optional<Result<viewer::OpenedFile>> result_of(viewer::Loader& loader, Wait&& wait) {
    for (int i = 0; i < 60'000; ++i) {
      if (auto result = loader.take_result()) return result;
      wait();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return std::nullopt;
  }

  const fs::path folder_ = fs::temp_directory_path() / ("etendue-loading-" + std::to_string(getpid()));
};

TEST_F(LoadingPicture, SceneIsCompleteApartFromItsImages) {
  const std::string file = written(3, 16);
  std::atomic<int> calls{0};
  scene::Scene early;
  scene::LoadOptions options;
  options.without_images = [&](const scene::Scene& scene) {
    early = scene;
    ++calls;
  };
  const auto complete = scene::load_gltf(file, options);
  ASSERT_TRUE(complete) << complete.error().message;
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE(early.nodes == complete->nodes && early.meshes == complete->meshes && early.roots == complete->roots);
  EXPECT_TRUE(early.materials == complete->materials);
  ASSERT_EQ(early.textures.size(), 3U);
  for (size_t i = 0; i < 3; ++i) EXPECT_TRUE(!early.textures[i].image && complete->textures[i].image) << i;
}

// The textures take much longer to decode than the picture takes.
TEST_F(LoadingPicture, IsKnownBeforeTheTextures) {
  const std::string file = written(4, 2048);
  viewer::Loader loader([] {});
  loader.open(file, {}, "");
  std::shared_ptr<const viewer::StoredPicture> picture;
  const auto opened = result_of(loader, [&] {
    if (const auto latest = loader.picture()) picture = latest;
  });
  ASSERT_TRUE(opened && *opened);
  ASSERT_TRUE(picture) << "there was no picture before the scene";
  ASSERT_EQ(picture->pixels.size(), static_cast<size_t>(picture->width) * static_cast<size_t>(picture->height));
  EXPECT_EQ(picture->width, (*opened)->document.width);
  // The squares are white without their textures, and the light is that of the environment for scenes without light.
  const Rgb centre = picture->pixels[picture->pixels.size() / 2 + static_cast<size_t>(picture->width) / 2];
  EXPECT_GT(std::min({centre.r, centre.g, centre.b}), 0.05f);
}

TEST_F(LoadingPicture, DefectiveImagesAndCancelledFilesEndIt) {
  const std::string file = written(2, 64);
  fs::resize_file(folder_ / "squares-1.png", 20);
  viewer::Loader loader([] {});
  loader.open(file, {}, "");
  loader.cancel();
  EXPECT_FALSE(loader.picture());
  loader.open(file, {}, "");
  const auto opened = result_of(loader, [] {});
  ASSERT_TRUE(opened && *opened);
  const scene::Scene& scene = *(*opened)->document.scene;
  EXPECT_TRUE(scene.textures[0].image);
  EXPECT_FALSE(scene.textures[1].image);
  ASSERT_FALSE(scene.warnings.empty());
}

}  // namespace
}  // namespace etendue::loading_picture_test
