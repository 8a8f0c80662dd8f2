// Reading images of any format as linear RGB.
#include <gtest/gtest.h>

#include <cmath>

#include "base/file.h"
#include "image/image.h"
#include "unit/image/file_bytes.h"

namespace etendue::test {
namespace {

using image::LayeredImage;
using image::read_linear;

const std::vector<std::string> kRgb{"R", "G", "B"};

// IEC 61966-2-1, in double.
double decode_srgb(int code) {
  const double x = code / 255.0;
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

Result<LayeredImage> read_bytes(const std::string& name, const FileBytes& bytes) {
  const TemporaryFile file(name);
  if (auto written = write_file(file.path(), bytes.data(), bytes.size()); !written) return written.error();
  return read_linear(file.path());
}

Result<LayeredImage> write_and_read_exr(const LayeredImage& image) {
  const TemporaryFile file("a.exr");
  if (auto written = image::write_exr(file.path(), image); !written) return written.error();
  return read_linear(file.path());
}

LayeredImage one_pixel(std::vector<image::Layer> layers) {
  LayeredImage image;
  image.width = 1;
  image.height = 1;
  image.layers = std::move(layers);
  return image;
}

TEST(ReadLinear, DecodesSrgb) {
  FileBytes row;
  for (int code = 0; code < 255; ++code) row.push_back(static_cast<char>(code));
  const auto image = read_bytes("a.png", png_file(85, 8, kTrueColour, {row}));
  ASSERT_TRUE(image) << image.error().message;
  ASSERT_EQ(image->layers.size(), 1u);
  EXPECT_EQ(image->layers[0].channels, kRgb);
  for (int code = 0; code < 255; ++code)
    EXPECT_NEAR(image->layers[0].pixels[static_cast<size_t>(code)], decode_srgb(code), 1e-6) << code;
}

TEST(ReadLinear, CopiesGreyAndDropsAlpha) {
  const auto grey = read_bytes("a.png", png_file(1, 8, kGreyAlpha, {"\xff\x01"}));
  ASSERT_TRUE(grey) << grey.error().message;
  EXPECT_EQ(grey->layers[0].pixels, (std::vector<float>{1, 1, 1}));
  const auto colour = read_bytes("a.png", png_file(1, 8, kTrueColourAlpha, {FileBytes("\xff\x00\xff\x07", 4)}));
  ASSERT_TRUE(colour) << colour.error().message;
  EXPECT_EQ(colour->layers[0].pixels, (std::vector<float>{1, 0, 1}));
}

TEST(ReadLinear, RecognisesFormatsByContent) {
  const auto image = read_bytes("a.jpg", png_file(1, 8, kGrey, {"\xff"}));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->layers[0].pixels, (std::vector<float>{1, 1, 1}));
}

TEST(ReadLinear, KeepsFloats) {
  const auto image =
      write_and_read_exr(one_pixel({{"", {"R", "G", "B", "A"}, {-1, 0.5f, 1e9f, 0.25f}}, {"depth", {"Z"}, {7}}}));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->layers.front().channels, kRgb);
  EXPECT_EQ(image->layers.front().pixels, (std::vector<float>{-1, 0.5f, 1e9f}));
  ASSERT_NE(image->find("depth"), nullptr);
  EXPECT_EQ(image->find("depth")->pixels, std::vector<float>{7});
}

TEST(ReadLinear, CopiesLuminance) {
  const auto image = write_and_read_exr(one_pixel({{"", {"Y"}, {0.5f}}}));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->find("")->pixels, (std::vector<float>{0.5f, 0.5f, 0.5f}));
}

TEST(ReadLinear, FindsTheCombinedLayerOfBlender) {
  const auto image = write_and_read_exr(one_pixel({{"View.AO", {"R", "G", "B"}, {1, 1, 1}},
                                                   {"View.Combined", {"R", "G", "B", "A"}, {2, 3, 4, 1}},
                                                   {"View.Depth", {"Z"}, {7}}}));
  ASSERT_TRUE(image) << image.error().message;
  ASSERT_NE(image->find(""), nullptr);
  EXPECT_EQ(image->find("")->pixels, (std::vector<float>{2, 3, 4}));
}

TEST(ReadLinear, RejectsFilesWithoutColour) { EXPECT_FALSE(write_and_read_exr(one_pixel({{"depth", {"Z"}, {7}}}))); }

}  // namespace
}  // namespace etendue::test
