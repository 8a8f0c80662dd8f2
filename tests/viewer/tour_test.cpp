// The tour of the guide: a scene from nothing, saved and opened again.
#include <cmath>
#include <cstdlib>

#include "scripted.h"

namespace etendue::tour_test {
namespace {

// The program runs in the folder of the test, because the script names files without a folder.
class Tour : public Viewer {
 protected:
  void SetUp() override {
    Viewer::SetUp();
    former_ = fs::current_path();
    fs::current_path(folder_);
  }
  void TearDown() override {
    fs::current_path(former_);
    Viewer::TearDown();
  }

  // The steps of the guide with fewer samples.
  static json steps() {
    std::ifstream in(fs::path(ETENDUE_SOURCE_DIR) / "assets/scripts/tour.json");
    json list = json::parse(in);
    for (json& step : list) {
      if (step.value("spp", 0) > 4) step["spp"] = 4;
      if (step.value("name", "") == "render.samples") step["value"] = 4;
    }
    return list;
  }

  // Moves each object of the tour and undoes that. The scene is the same, but all objects are instances then.
  static json touch_all() {
    json list = json::array();
    for (int node = 1; node <= 5; ++node)
      for (const json& step : {set("node." + std::to_string(node) + ".translation.y", 0.5),
                               json{{"do", "wait"}, {"spp", 1}}, key("ctrl+z"), json{{"do", "wait"}, {"spp", 1}}})
        list.push_back(step);
    list.push_back({{"do", "wait"}, {"spp", 4}});
    list.push_back(file_step("image", "touched.exr"));
    return list;
  }

  // The share of pixels that differ by more than rounding. Edited objects are instances, and objects of a file may be part
  // of the scene's own hierarchy: rays past an edge round differently, and the paths behind them are others.
  double share_that_differs(const char* a, const char* b) const {
    const auto x = saved_image(a).find("")->pixels, y = saved_image(b).find("")->pixels;
    EXPECT_EQ(x.size(), y.size());
    size_t different = 0;
    for (size_t i = 0; i < std::min(x.size(), y.size()); ++i)
      different += std::abs(x[i] - y[i]) > 1e-4f * (1 + std::abs(x[i]));
    return static_cast<double>(different) / static_cast<double>(x.size());
  }

 private:
  fs::path former_;
};

TEST_F(Tour, BuildsASceneFromNothingThatIsTheSameWhenReopened) {
  ASSERT_EQ(run(steps(), "new", 1280, 720), 0);
  EXPECT_LT(share_that_differs("tour-before.exr", "tour-after.exr"), 1e-4);
  EXPECT_LT(share_that_differs("tour-before.exr", "tour-gltf.exr"), 1e-4);
  // The session and the glTF file are both opened from files.
  EXPECT_EQ(share_that_differs("tour-after.exr", "tour-gltf.exr"), 0);
  // With all objects as instances, the reopened scene has the bits of the edited one.
  ASSERT_EQ(run(joined(json::array({{{"do", "wait"}, {"spp", 4}}}), touch_all()), "tour.etendue", 1280, 720), 0);
  EXPECT_EQ(saved_image("touched.exr").find("")->pixels, saved_image("tour-before.exr").find("")->pixels);
  // Without the viewer.
  ASSERT_EQ(
      std::system((std::string(ETENDUE_BINARY) + " render tour.etendue -o tour-rendered.exr 2> errors.txt").c_str()),
      0);
  EXPECT_EQ(share_that_differs("tour-after.exr", "tour-rendered.exr"), 0);
  // There is something to see, and the painting is part of it.
  const auto pixels = saved_image("tour-before.exr").find("")->pixels;
  EXPECT_GT(*std::ranges::max_element(pixels), 0.1f);
  EXPECT_GT(fs::file_size("tour.glb"), 100'000U) << "the texture is stored in the file";
}

}  // namespace
}  // namespace etendue::tour_test
