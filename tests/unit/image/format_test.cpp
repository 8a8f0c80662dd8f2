// The registry of image formats: properties of every entry.
#include "image/format.h"

#include <gtest/gtest.h>

#include <set>

#include "base/file.h"
#include "image/plugin.h"
#include "unit/image/file_bytes.h"

namespace etendue::test {
namespace {

using image::ImageFormat;

class EveryImageFormat : public testing::TestWithParam<const ImageFormat*> {};

TEST_P(EveryImageFormat, IsDescribed) {
  const ImageFormat& format = *GetParam();
  EXPECT_FALSE(format.name.empty() || format.label.empty() || format.doc.empty());
  EXPECT_TRUE(format.extensions[0].starts_with('.'));
  EXPECT_NE(format.decode == nullptr, format.decode_layers == nullptr) << "exactly one reader";
}

// A file written by the format is recognised as that format and read as linear RGB.
TEST_P(EveryImageFormat, ReadsWhatItWrites) {
  const ImageFormat& format = *GetParam();
  if (!format.can_write()) GTEST_SKIP() << format.name << " is not written";
  if (format.writes_by_plugin && !image::image_plugin()) GTEST_SKIP() << image::image_plugin().error().message;
  const TemporaryFile file("a" + std::string(format.extensions[0]));
  ASSERT_EQ(image::find_writer(file.path()), &format);
  const std::vector<float> white(36 * 34 * 3, 1.0f);
  const std::vector<uint8_t> bytes(white.size(), 255);
  if (format.write_layers) {
    image::LayeredImage layered{.width = 36, .height = 34};
    layered.layers.push_back({"", {"R", "G", "B"}, white});
    ASSERT_TRUE(format.write_layers(file.path(), layered));
  }
  if (format.write_linear) {
    ASSERT_TRUE(format.write_linear(file.path(), 36, 34, white));
  }
  if (format.write_display) {
    const auto written = format.write_display(file.path(), 36, 34, bytes, {});
    ASSERT_TRUE(written) << written.error().message;
  }
  const auto stored = read_file(file.path());
  ASSERT_TRUE(stored);
  EXPECT_EQ(image::recognise_format(*stored), &format);
  const auto linear = image::read_linear(file.path());
  ASSERT_TRUE(linear) << linear.error().message;
  // Lossy formats convert to luminance and chrominance, which rounds.
  const std::vector<float>& pixels = linear->layers.front().pixels;
  ASSERT_EQ(pixels.size(), white.size());
  for (const float value : pixels) EXPECT_NEAR(value, 1, format.writes_by_plugin ? 0.01f : 0);
}

INSTANTIATE_TEST_SUITE_P(Formats, EveryImageFormat,
                         testing::ValuesIn(image::image_formats().begin(), image::image_formats().end()),
                         [](const auto& instance) { return std::string(instance.param->name); });

TEST(ImageFormats, NamesAndExtensionsAreUnique) {
  std::set<std::string_view> names, extensions;
  for (const ImageFormat* format : image::image_formats()) {
    EXPECT_TRUE(names.insert(format->name).second) << format->name;
    for (const std::string_view extension : format->extensions)
      EXPECT_TRUE(extension.empty() || extensions.insert(extension).second) << extension;
  }
}

TEST(ImageFormats, FindWriterIgnoresCaseAndRejectsOthers) {
  ASSERT_NE(image::find_writer("folder.png/A.EXR"), nullptr);
  EXPECT_EQ(image::find_writer("folder.png/A.EXR")->name, "exr");
  for (const char* path : {"a.psd", "a.txt", "a", ".exr", ""}) EXPECT_EQ(image::find_writer(path), nullptr) << path;
}

TEST(ImageFormats, RequiredWritersSayWhichExtensionsAreWritten) {
  const auto unknown = image::require_writer("a.xyz");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().fault, Fault::usage);
  EXPECT_NE(unknown.error().message.find("'.xyz' is not a supported output format; use .png, "), std::string::npos);
  EXPECT_EQ((*image::require_writer("a.png"))->name, "png");
}

}  // namespace
}  // namespace etendue::test
