// The registry of image formats: properties of every entry.
#include "image/format.h"

#include <gtest/gtest.h>

#include <set>

#include "base/file.h"
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
  const TemporaryFile file("a" + std::string(format.extensions[0]));
  ASSERT_EQ(image::find_writer(file.path()), &format);
  const std::vector<float> white(6, 1.0f);
  const std::vector<uint8_t> bytes(6, 255);
  if (format.write_layers) {
    image::LayeredImage layered{.width = 2, .height = 1};
    layered.layers.push_back({"", {"R", "G", "B"}, white});
    ASSERT_TRUE(format.write_layers(file.path(), layered));
  }
  if (format.write_linear) {
    ASSERT_TRUE(format.write_linear(file.path(), 2, 1, white));
  }
  if (format.write_display) {
    ASSERT_TRUE(format.write_display(file.path(), 2, 1, bytes, {}));
  }
  const auto stored = read_file(file.path());
  ASSERT_TRUE(stored);
  EXPECT_EQ(image::recognise_format(*stored), &format);
  const auto linear = image::read_linear(file.path());
  ASSERT_TRUE(linear) << linear.error().message;
  EXPECT_EQ(linear->layers.front().pixels, white);
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
  for (const char* path : {"a.jpg", "a.txt", "a", ".exr", ""}) EXPECT_EQ(image::find_writer(path), nullptr) << path;
}

}  // namespace
}  // namespace etendue::test
