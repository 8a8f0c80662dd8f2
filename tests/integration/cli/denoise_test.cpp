// Denoised images of the command line, also with a stand-in for the library Open Image Denoise
// (open_image_denoise/library.cpp).
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "image/image.h"
#include "integration/cli/cli.h"

namespace etendue::test::denoise_test {
namespace {

// Sets an environment variable for the programs that a test starts.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) { ::setenv(name, value, 1); }
  ~Environment() { ::unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
};

std::vector<float> pixels_of(const fs::path& file, const char* layer = "") {
  const auto image = image::read_exr(file.string());
  EXPECT_TRUE(image) << file;
  return image ? image->find(layer)->pixels : std::vector<float>();
}

TEST_F(Cli, DenoisedImageIsAnAdditionalFile) {
  ASSERT_EQ(run("render cornell --size 48x48 --spp 8 -o a.exr").code, 0);
  ASSERT_EQ(run("render cornell --size 48x48 --spp 8 -o b.exr --denoise denoised.exr").code, 0);
  ASSERT_EQ(run("render cornell --size 48x48 --spp 512 --seed 3 -o reference.exr").code, 0);
  EXPECT_EQ(nlohmann::json::parse(run("compare a.exr b.exr --json").out)["mse"], 0);
  const auto relmse = [&](const std::string& file) {
    return nlohmann::json::parse(run("compare " + file + " reference.exr --json").out)["relmse"].get<double>();
  };
  EXPECT_LT(relmse("denoised.exr"), relmse("a.exr") / 2);
  const std::string file = slurp(folder_ / "denoised.exr");
  EXPECT_NE(file.find("etendue:denoised"), std::string::npos);
  EXPECT_EQ(file.find("variance"), std::string::npos);
  EXPECT_EQ(run("render cornell --size 48x48 --spp 8 -o c.exr --denoise c.png").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "c.png"));
  expect_error("render cornell --samples 0:4 -o p.exr --denoise d.exr", 2, "--denoise");
}

TEST_F(Cli, MergedPartsAreDenoised) {
  ASSERT_EQ(run("render cornell --size 48x48 --spp 8 -o a.exr --denoise whole.exr --denoiser regression").code, 0);
  ASSERT_EQ(run("render cornell --size 48x48 --samples 0:4 -o p1.exr").code, 0);
  ASSERT_EQ(run("render cornell --size 48x48 --samples 4:8 -o p2.exr").code, 0);
  ASSERT_EQ(run("merge p1.exr p2.exr -o b.exr --denoise merged.exr --denoiser regression").code, 0);
  EXPECT_EQ(nlohmann::json::parse(run("compare whole.exr merged.exr --json").out)["mse"], 0);
}

TEST_F(Cli, OpenImageDenoiseThatIsMissingIsAnError) {
  const Environment nowhere("LD_LIBRARY_PATH", folder_.c_str());
  expect_error("render cornell --spp 1 -o a.exr --denoise d.exr --denoiser oidn", 2, "libOpenImageDenoise.so.2");
  EXPECT_FALSE(fs::exists(folder_ / "a.exr"));
  expect_error("bench cornell --methods path:denoise=oidn --samples 1 -o b", 2, "libOpenImageDenoise.so.2");
}

// The stand-in averages the image and the albedo, and adds the normal.
TEST_F(Cli, OpenImageDenoiseReceivesImageAndFeatures) {
  const Environment library("LD_LIBRARY_PATH", ETENDUE_OIDN_FOLDER);
  for (const char* denoiser : {"oidn", "auto"}) {
    const std::string command =
        "render cornell --size 16x16 --spp 64 -o a.exr --aov albedo,shading-normal --denoise d.exr";
    ASSERT_EQ(run(command + " --denoiser " + denoiser).code, 0);
    const auto image = pixels_of(folder_ / "a.exr"), albedo = pixels_of(folder_ / "a.exr", "albedo"),
               normal = pixels_of(folder_ / "a.exr", "shading-normal"), denoised = pixels_of(folder_ / "d.exr");
    ASSERT_EQ(denoised.size(), image.size());
    double difference = 0;  // of features that are sampled again
    for (size_t i = 0; i < image.size(); ++i)
      difference += std::abs(double{denoised[i]} - (double{image[i]} + double{albedo[i]}) / 2 - double{normal[i]});
    EXPECT_LT(difference / static_cast<double>(image.size()), 0.02);
    EXPECT_EQ(image::read_exr((folder_ / "d.exr").string())->attributes.at("etendue:denoised"), "oidn");
  }
}

TEST_F(Cli, FaultsOfOpenImageDenoiseAreErrorsUnlessAnotherOneIsAllowed) {
  const Environment library("LD_LIBRARY_PATH", ETENDUE_OIDN_FOLDER), fault("OIDN_TEST_FAULT", "1");
  expect_error("render cornell --size 8x8 --spp 2 -o a.exr --denoise d.exr --denoiser oidn", 3, "out of memory");
  ASSERT_EQ(run("render cornell --size 8x8 --spp 2 -o a.exr --denoise d.exr").code, 0);
  EXPECT_EQ(image::read_exr((folder_ / "d.exr").string())->attributes.at("etendue:denoised"), "regression");
}

}  // namespace
}  // namespace etendue::test::denoise_test
