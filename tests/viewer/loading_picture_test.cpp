// The picture of a scene while its textures are being read.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>

#include "scene/gltf/load_gltf.h"
#include "support/textured_gltf.h"
#include "viewer/files/loader.h"
#include "viewer/files/loading_picture.h"

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

  // Waits until the file is open, for at most a minute.
  static std::optional<Result<viewer::OpenedFile>> result_of(viewer::Loader& loader) {
    for (int i = 0; i < 60'000; ++i) {
      if (auto result = loader.take_result()) return result;
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

// A scene whose textures have no images yet.
TEST_F(LoadingPicture, ShowsTheSceneWithoutItsTextures) {
  const std::string file = written(3, 16);
  auto scene = scene::load_gltf(file);
  ASSERT_TRUE(scene);
  for (Texture& texture : scene->textures) texture.image.reset();
  std::mutex mutex;
  std::shared_ptr<const viewer::StoredPicture> shown;
  const auto latest = [&] {
    const std::lock_guard lock(mutex);
    return shown;
  };
  viewer::LoadingPicture picture(file, "", [&](std::shared_ptr<const viewer::StoredPicture> p) {
    const std::lock_guard lock(mutex);
    shown = std::move(p);
  });
  const auto start = std::chrono::steady_clock::now();
  picture.start(*scene);
  for (int i = 0; i < 60'000 && !latest(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_TRUE(latest());
  EXPECT_GE(std::chrono::steady_clock::now() - start, viewer::LoadingPicture::kPatience);
  const viewer::StoredPicture& p = *latest();
  ASSERT_EQ(p.pixels.size(), static_cast<size_t>(p.width) * static_cast<size_t>(p.height));
  // The squares are white without their textures, and the light is that of scenes without light.
  const Rgb centre = p.pixels[p.pixels.size() / 2 + static_cast<size_t>(p.width) / 2];
  EXPECT_GT(std::min({centre.r, centre.g, centre.b}), 0.05f);
}

TEST_F(LoadingPicture, EndsWithItsObject) {
  const std::string file = written(1, 16);
  const auto scene = scene::load_gltf(file);
  ASSERT_TRUE(scene);
  const auto start = std::chrono::steady_clock::now();
  bool is_shown = false;
  for (int i = 0; i < 20; ++i) {
    viewer::LoadingPicture picture(file, "", [&](const auto&) { is_shown = true; });
    picture.start(*scene);
  }
  EXPECT_FALSE(is_shown) << "after " << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST_F(LoadingPicture, DefectiveImagesAndCancelledFilesEndIt) {
  const std::string file = written(2, 64);
  fs::resize_file(folder_ / "squares-1.png", 20);
  viewer::Loader loader([] {});
  loader.open(file, {}, "");
  loader.cancel();
  EXPECT_FALSE(loader.picture());
  loader.open(file, {}, "");
  const auto opened = result_of(loader);
  ASSERT_TRUE(opened && *opened);
  const scene::Scene& scene = *(*opened)->document.scene;
  EXPECT_TRUE(scene.textures[0].image);
  EXPECT_FALSE(scene.textures[1].image);
  ASSERT_FALSE(scene.warnings.empty());
}

}  // namespace
}  // namespace etendue::loading_picture_test
