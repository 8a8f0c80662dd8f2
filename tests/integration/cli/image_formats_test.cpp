// Image formats beyond the native ones, and --texture-memory, as a user has them.
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "integration/cli/cli.h"

namespace etendue::test::image_formats_test {
namespace {

class ImageFormatsCli : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    unsetenv("ETENDUE_PLUGIN_PATH");
  }

  // The plugin is next to the program.
  bool has_plugin() const { return fs::exists(fs::path(ETENDUE_BINARY).parent_path() / "libetendue_openimageio.so"); }

  double rmse(const std::string& image, const std::string& reference) const {
    const Outcome r = run("compare --json " + image + " " + reference);
    EXPECT_EQ(r.code, 0) << r.err;
    return r.code == 0 ? nlohmann::json::parse(r.out)["rmse"].get<double>() : -1;
  }
};

TEST_F(ImageFormatsCli, ImagesOfAllFormatsAreComparedWithTheOriginal) {
  if (!has_plugin()) GTEST_SKIP() << "built without OpenImageIO";
  for (const char* output : {"a.exr", "a.png", "a.tif", "a.tga", "a.jp2", "a.bmp", "a.ppm", "a.dpx", "a.heic"}) {
    const Outcome r = run(std::string("render cornell --size 40x40 --spp 2 -o ") + output);
    EXPECT_EQ(r.code, 0) << output << ": " << r.err;
  }
  EXPECT_EQ(rmse("a.tif", "a.exr"), 0);
  for (const char* lossless : {"a.tga", "a.bmp", "a.ppm", "a.dpx"})
    EXPECT_LT(rmse(lossless, "a.png"), 1e-5) << lossless;
  for (const char* lossy : {"a.jp2", "a.heic"}) EXPECT_LT(rmse(lossy, "a.png"), 0.1) << lossy;
}

TEST_F(ImageFormatsCli, EnvironmentMapsMayHaveAnyFormat) {
  if (!has_plugin()) GTEST_SKIP() << "built without OpenImageIO";
  ASSERT_EQ(run("render cornell --size 64x32 --spp 2 -o env.exr").code, 0);
  ASSERT_EQ(run("render cornell --size 64x32 --spp 2 -o env.tif").code, 0);
  for (const std::string format : {"exr", "tif"})
    ASSERT_EQ(run("render cornell --size 16x16 --spp 2 --env env." + format + " -o lit-" + format + ".exr").code, 0);
  EXPECT_EQ(rmse("lit-tif.exr", "lit-exr.exr"), 0);
}

TEST_F(ImageFormatsCli, MissingPluginIsReportedBeforeRendering) {
  setenv("ETENDUE_PLUGIN_PATH", folder_.c_str(), 1);
  expect_error("render cornell -o a.tif", 4, "install the package libopenimageio-dev");
  expect_error("render cornell -o a.exr --texture-memory 1G", 2, "install the package libopenimageio-dev");
  EXPECT_EQ(run("render cornell --size 8x8 --spp 1 -o a.png").code, 0) << "native formats do not need it";
}

TEST_F(ImageFormatsCli, TextureMemoryIsASize) {
  expect_error("render cornell -o a.exr --texture-memory much", 2, "512M");
}

TEST_F(ImageFormatsCli, TexturesBeyondTheBudgetGiveTheSameImage) {
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  if (!data || !has_plugin()) GTEST_SKIP() << "needs ETENDUE_TEST_DATA and OpenImageIO";
  setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
  const std::string render = "render " + std::string(data) + "/gltf/BoxTextured.glb --size 200x200 --spp 16 -o ";
  ASSERT_EQ(run(render + "a.exr").code, 0);
  ASSERT_EQ(run(render + "b.exr --texture-memory 1G").code, 0);
  EXPECT_EQ(rmse("b.exr", "a.exr"), 0) << "the textures fit into memory";
  EXPECT_FALSE(fs::exists(folder_ / "etendue" / "textures"));
  ASSERT_EQ(run(render + "c.exr --texture-memory 100K").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "etendue" / "textures"));
  EXPECT_LT(rmse("c.exr", "a.exr"), 0.02) << "only the mip level differs";
}

}  // namespace
}  // namespace etendue::test::image_formats_test
