// Formats that are read and written through OpenImageIO. Skipped where the plugin is not built.
#include "image/plugin.h"
#include "image/plugin_io.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "base/file.h"
#include "image/format.h"
#include "unit/image/file_bytes.h"

namespace etendue::test {
namespace {

using image::decode_image;
using image::PixelType;
using image::read_linear;

constexpr int kColumns = 40, kRows = 36;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

void store(const std::filesystem::path& path, const FileBytes& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

class PluginFormats : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto plugin = image::image_plugin(); !plugin) GTEST_SKIP() << plugin.error().message;
  }
};

// ---- Round trips

struct RoundTrip {
  const char* extension;
  int tolerance;  // of 8-bit values
};

class WrittenFormats : public PluginFormats, public testing::WithParamInterface<RoundTrip> {};

// Smooth, so that lossy compression changes it by a few codes only.
std::vector<uint8_t> ramp() {
  std::vector<uint8_t> pixels;
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kColumns; ++x)
      for (const int value : {40 + 4 * x, 60 + 3 * y, 30 + 2 * x + 3 * y})
        pixels.push_back(static_cast<uint8_t>(value));
  return pixels;
}

// The written values are read back: as bytes by decode_image, and decoded from sRGB by read_linear.
TEST_P(WrittenFormats, KeepDisplayedValues) {
  const TemporaryFile file(std::string("a") + GetParam().extension);
  const image::ImageFormat* format = image::find_writer(file.path());
  ASSERT_TRUE(format && format->write_display);
  const auto written = format->write_display(file.path(), kColumns, kRows, ramp(), {});
  ASSERT_TRUE(written) << written.error().message;

  const auto image = decode_image(*read_file(file.path()), "a");
  ASSERT_TRUE(image) << image.error().message;
  ASSERT_EQ(image->type, PixelType::byte8);
  ASSERT_EQ(image->channels, 3);
  ASSERT_EQ(image->bytes.size(), ramp().size());
  for (size_t i = 0; i < image->bytes.size(); ++i) EXPECT_NEAR(image->bytes[i], ramp()[i], GetParam().tolerance) << i;

  const auto linear = read_linear(file.path());
  ASSERT_TRUE(linear) << linear.error().message;
  const std::vector<float>& values = linear->layers.front().pixels;
  ASSERT_EQ(values.size(), ramp().size());
  for (size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(linear_to_srgb(values[i]) * 255, ramp()[i], static_cast<float>(GetParam().tolerance) + 1e-3f) << i;
}

INSTANTIATE_TEST_SUITE_P(Formats, WrittenFormats,
                         testing::Values(RoundTrip{".tga", 0}, RoundTrip{".bmp", 0}, RoundTrip{".ppm", 0},
                                         RoundTrip{".sgi", 0}, RoundTrip{".dpx", 0}, RoundTrip{".jp2", 4},
                                         RoundTrip{".jpg", 6}, RoundTrip{".webp", 8}, RoundTrip{".heic", 12}),
                         [](const auto& instance) { return std::string(instance.param.extension + 1); });

TEST_F(PluginFormats, LinearFormatsKeepFloats) {
  const std::vector<float> values{0, 1e-6f, 0.5f, 1, 1234.5f, 1e30f};
  for (const char* name : {"a.tif", "a.tiff"}) {
    const TemporaryFile file(name);
    const image::ImageFormat* format = image::find_writer(file.path());
    ASSERT_TRUE(format && format->write_linear) << name;
    const auto written = format->write_linear(file.path(), 1, 2, values);
    ASSERT_TRUE(written) << written.error().message;
    const auto linear = read_linear(file.path());
    ASSERT_TRUE(linear) << linear.error().message;
    EXPECT_EQ(linear->layers.front().pixels, values) << name;
    const auto image = decode_image(*read_file(file.path()), "a");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->floats, values) << name;
  }
}

TEST_F(PluginFormats, SmallJpeg2000ImagesAreNotWritten) {
  const TemporaryFile file("a.jp2");
  EXPECT_FALSE(image::write_display_by_plugin(file.path(), 1, 1, std::vector<uint8_t>(3), {}));
  EXPECT_FALSE(std::filesystem::exists(file.path()));
}

TEST_F(PluginFormats, WritersReportMissingFolders) {
  const TemporaryFile file("a.tif");
  const std::vector<float> pixel(3, 1.0f);
  EXPECT_FALSE(image::write_linear_by_plugin(file.folder() / "missing" / "a.tif", 1, 1, pixel));
  EXPECT_FALSE(image::write_linear_by_plugin(file.path(), 2, 1, pixel));
  EXPECT_FALSE(std::filesystem::exists(file.path()));
}

// ---- Files assembled from the specifications

// Truevision TGA, image type 2: 32 bits per pixel as BGRA, the lower row first.
FileBytes targa(uint16_t width, uint16_t height, const FileBytes& pixels) {
  FileBytes out("\0\0\2\0\0\0\0\0\0\0\0\0", 12);
  append_little_endian(out, width);
  append_little_endian(out, height);
  return out + FileBytes("\x20\x08", 2) + pixels;
}

TEST_F(PluginFormats, TargaKeepsAlphaAndOrientation) {
  const FileBytes lower("\x01\x02\x03\x80", 4), upper("\x0a\x0b\x0c\x40", 4);
  const auto image = decode_image(view(targa(1, 2, lower + upper)), "a.tga");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->bytes, (std::vector<uint8_t>{12, 11, 10, 64, 3, 2, 1, 128}));
}

TEST_F(PluginFormats, SixteenBitsAreRoundedForTexturesOnly) {
  const FileBytes file = FileBytes("P5 2 1 65535\n") + FileBytes("\x80\x00\xff\xff", 4);
  const auto image = decode_image(view(file), "a.pgm");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->channels, 1);
  EXPECT_EQ(image->bytes, (std::vector<uint8_t>{128, 255}));

  const TemporaryFile stored("a.pgm");
  store(stored.path(), file);
  const auto linear = read_linear(stored.path());
  ASSERT_TRUE(linear) << linear.error().message;
  const float grey = srgb_to_linear(32768.0f / 65535.0f);
  const std::vector<float> expected{grey, grey, grey, 1, 1, 1};
  ASSERT_EQ(linear->layers.front().pixels.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(linear->layers.front().pixels[i], expected[i], 1e-4f);
}

// Adobe Photoshop, version 1: RGB, 8 bits, planes without compression.
TEST_F(PluginFormats, PhotoshopIsRead) {
  FileBytes file("8BPS\0\1\0\0\0\0\0\0\0\3", 14);
  append_big_endian(file, 1);
  append_big_endian(file, 2);
  file += FileBytes("\0\x08\0\3\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 18) + FileBytes("\1\2\3\4\5\6", 6);
  const auto image = decode_image(view(file), "a.psd");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->bytes, (std::vector<uint8_t>{1, 3, 5, 2, 4, 6}));
}

// DirectDraw Surface: 2 x 1 pixels of 32 bits, uncompressed.
FileBytes direct_draw_surface(const std::array<uint32_t, 4>& masks) {
  FileBytes file("DDS ");
  for (const uint32_t v : {124u, 0x100fu, 1u, 2u, 8u, 0u, 0u}) append_little_endian(file, v);
  file.append(44, '\0');
  for (const uint32_t v : {32u, 0x41u, 0u, 32u, masks[0], masks[1], masks[2], masks[3], 0x1000u, 0u, 0u, 0u, 0u})
    append_little_endian(file, v);
  return file + FileBytes("\3\2\1\xff\6\5\4\x80", 8);
}

TEST_F(PluginFormats, DirectDrawSurfacesAreRead) {
  const FileBytes file = direct_draw_surface({0xff0000u, 0xff00u, 0xffu, 0xff000000u});
  const auto image = decode_image(view(file), "a.dds");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->bytes, (std::vector<uint8_t>{1, 2, 3, 255, 4, 5, 6, 128}));
}

// GIF 87a: one pixel with the second colour of a palette of two, compressed as clear, 1, end.
TEST_F(PluginFormats, GifIsRead) {
  const FileBytes file = FileBytes("GIF87a\1\0\1\0\x80\0\0", 13) + FileBytes("\1\2\3\x0a\x0b\x0c", 6) +
                         FileBytes("\x2c\0\0\0\0\1\0\1\0\0", 10) + FileBytes("\2\2\x4c\1\0\x3b", 6);
  const auto image = decode_image(view(file), "a.gif");
  ASSERT_TRUE(image) << image.error().message;
  ASSERT_GE(image->bytes.size(), 3U);
  EXPECT_EQ((std::vector<uint8_t>(image->bytes.begin(), image->bytes.begin() + 3)), (std::vector<uint8_t>{10, 11, 12}));
}

// Portable float map: the lower row first, the sign of the scale is that of little-endian numbers.
TEST_F(PluginFormats, FloatMapsAreRead) {
  FileBytes file("PF\n1 2\n-1.0\n");
  for (const float v : {1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 600.0f}) append_little_endian(file, v);
  const auto image = decode_image(view(file), "a.pfm");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->floats, (std::vector<float>{4, 5, 600, 1, 2, 3}));
}

// ---- Camera raw

// Digital Negative 1.4: a sensor of red, green and blue pixels, all with the same value, and a camera whose colours are
// those of sRGB.
FileBytes digital_negative(uint16_t value) {
  constexpr uint32_t kSize = 64;
  const auto shorts = [](uint16_t number, const std::vector<uint16_t>& values) {
    return tiff_tag(number, TiffType::uint16, values);
  };
  const auto longs = [](uint16_t number, uint32_t v) { return tiff_tag<uint32_t>(number, TiffType::uint32, {v}); };
  const auto text = [](uint16_t number, const std::string& s) {
    return tiff_tag(number, TiffType::ascii, std::vector<char>(s.c_str(), s.c_str() + s.size() + 1));
  };
  const std::vector<int32_t> from_xyz{32406, 10000, -15372, 10000, -4986, 10000, -9689, 10000, 18758,
                                      10000, 415,   10000,  557,   10000, -2040, 10000, 10570, 10000};
  const std::vector<TiffTag> tags{
      longs(254, 0),
      longs(256, kSize),
      longs(257, kSize),
      shorts(258, {16}),
      shorts(259, {1}),
      shorts(262, {32803}),  // a colour filter array
      text(271, "Maker"),
      text(272, "Model"),
      shorts(274, {1}),
      shorts(277, {1}),
      longs(278, kSize),
      longs(279, 2 * kSize * kSize),
      shorts(33421, {2, 2}),                                   // red, green
      tiff_tag<uint8_t>(33422, TiffType::byte, {0, 1, 1, 2}),  // green, blue
      tiff_tag<uint8_t>(50706, TiffType::byte, {1, 4, 0, 0}),  // version
      text(50708, "Maker Model"),
      longs(50717, 65535),                                                // white level
      tiff_tag(50721, TiffType::signed_rational, from_xyz),               // colour matrix
      tiff_tag<uint32_t>(50728, TiffType::rational, {1, 1, 1, 1, 1, 1}),  // neutral
      shorts(50778, {21}),                                                // under D65
  };
  FileBytes pixels;
  for (uint32_t i = 0; i < kSize * kSize; ++i) append_little_endian(pixels, value);
  return tiff_file(tags, pixels);
}

TEST_F(PluginFormats, CameraRawFilesAreDeveloped) {
  const TemporaryFile file("a.dng");
  for (const uint16_t value : {6554, 32768}) {
    store(file.path(), digital_negative(value));
    const auto linear = read_linear(file.path());
    ASSERT_TRUE(linear) << linear.error().message;
    const auto& pixels = linear->layers.front().pixels;
    ASSERT_EQ(pixels.size() % 3, 0U);
    for (size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(pixels[pixels.size() / 2 / 3 * 3 + c], value / 65535.0, 0.01) << "channel " << c;
  }
}

// The file dialog and files that are dropped on the viewer go by the extension.
TEST(ImageFormats, ExtensionsOfCameraRawAreKnown) {
  const auto known = image::readable_extensions();
  for (const char* extension : {".dng", ".nef", ".cr2", ".arw"})
    EXPECT_TRUE(std::ranges::find(known, extension) != known.end()) << extension;
}

TEST_F(PluginFormats, ExrFilesAreTextures) {
  const FileBytes half = sample(0.5f), two = sample(2.0f);
  const FileBytes file =
      exr_file({{"B", ExrType::float32, {half}}, {"G", ExrType::float32, {two}}, {"R", ExrType::float32, {half}}},
               {0, 0, 0, 0}, {0, 0, 0, 0});
  const auto image = decode_image(view(file), "a.exr");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->floats, (std::vector<float>{0.5f, 2.0f, 0.5f}));
}

// ---- Damaged files

std::vector<std::string> written_extensions() {
  return {".tif", ".ppm", ".bmp", ".dpx", ".jp2", ".heic", ".sgi", ".tga"};
}

FileBytes file_of(const std::string& extension) {
  const TemporaryFile file("a" + extension);
  const image::ImageFormat* format = image::find_writer(file.path());
  const std::vector<uint8_t> values = ramp();
  const std::vector<float> linear(values.begin(), values.end());
  const auto written = format->write_linear ? format->write_linear(file.path(), kColumns, kRows, linear)
                                            : format->write_display(file.path(), kColumns, kRows, ramp(), {});
  EXPECT_TRUE(written) << written.error().message;
  const auto bytes = read_file(file.path());
  return FileBytes(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

TEST_F(PluginFormats, TruncatedFilesAreErrors) {
  for (const std::string& extension : written_extensions()) {
    const FileBytes whole = file_of(extension);
    const auto image = decode_image(view(whole.substr(0, whole.size() / 2)), "a" + extension);
    ASSERT_FALSE(image) << extension;
    EXPECT_TRUE(contains(image.error().message, "a" + extension + ": ")) << extension;
    EXPECT_FALSE(contains(image.error().message, "/proc/")) << extension;
  }
}

// Random changes of bytes: any result is allowed, the size of which agrees with the header.
TEST_F(PluginFormats, DamagedFilesDoNotEndTheProgram) {
  std::mt19937 random(1);
  for (const std::string& extension : written_extensions()) {
    const FileBytes whole = file_of(extension);
    for (int round = 0; round < 100; ++round) {
      FileBytes damaged = whole;
      for (int change = 0; change < 4; ++change)
        damaged[random() % std::min<size_t>(damaged.size(), 400)] = static_cast<char>(random());
      const auto image = decode_image(view(damaged), "a" + extension);
      if (!image) continue;
      const size_t values = image->bytes.size() + image->floats.size();
      EXPECT_EQ(values, static_cast<size_t>(image->width) * static_cast<size_t>(image->height) *
                            static_cast<size_t>(image->channels));
    }
  }
}

// OpenImageIO 2.4 does not end with the first, and allocates gigabytes for the others.
TEST_F(PluginFormats, DamagedHeadersAreErrors) {
  for (size_t channel = 0; channel < 4; ++channel) {
    std::array<uint32_t, 4> masks{0xff0000u, 0xff00u, 0xffu, 0xff000000u};
    masks[channel] = 0;
    const auto image = decode_image(view(direct_draw_surface(masks)), "a.dds");
    ASSERT_FALSE(image) << channel;
    EXPECT_TRUE(contains(image.error().message, "mask")) << image.error().message;
  }
  FileBytes photoshop("8BPS\0\1\0\0\0\0\0\0\0\3", 14);
  append_big_endian(photoshop, 1);
  append_big_endian(photoshop, 2);
  photoshop += FileBytes("\0\x08\0\3\x7f\xff\0\0", 8) + FileBytes(64, '\1');
  const auto image = decode_image(view(photoshop), "a.psd");
  ASSERT_FALSE(image);
  EXPECT_TRUE(contains(image.error().message, "longer than the file")) << image.error().message;
  // The size of the user data, in both byte orders.
  for (const char* magic : {"SDPX", "XPDS"}) {
    FileBytes picture = FileBytes(magic) + FileBytes(28, '\0') + FileBytes("\x49\x49\x49\x49") + FileBytes(2048, '\0');
    const auto damaged = decode_image(view(picture), "a.dpx");
    ASSERT_FALSE(damaged);
    EXPECT_TRUE(contains(damaged.error().message, "longer than the file")) << damaged.error().message;
  }
}

TEST_F(PluginFormats, HugeSizesAreRejectedBeforeMemoryIsAllocated) {
  const auto image = decode_image(view(targa(65535, 65535, "")), "a.tga");
  ASSERT_FALSE(image);
  EXPECT_TRUE(contains(image.error().message, "65535 x 65535"));
}

// ---- The plugin

TEST(ImagePlugin, IsReportedMissing) {
  const TemporaryFile nothing("empty");
  const auto plugin = image::load_image_plugin({nothing.folder()});
  ASSERT_FALSE(plugin);
  EXPECT_TRUE(contains(plugin.error().message, "install the package libopenimageio-dev"));
}

TEST(ImagePlugin, IsReportedIfItCannotBeLoaded) {
  const TemporaryFile file("libetendue_openimageio.so");
  store(file.path(), "no library");
  const auto plugin = image::load_image_plugin({file.folder()});
  ASSERT_FALSE(plugin);
  EXPECT_TRUE(contains(plugin.error().message, "install the package libopenimageio2.4"));
}

}  // namespace
}  // namespace etendue::test
