// Reading and writing OpenEXR: exact round trips, data and display windows, damaged files.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "base/file.h"
#include "image/format.h"
#include "unit/image/file_bytes.h"

namespace etendue::test {
namespace {

using image::Layer;
using image::LayeredImage;
using image::read_exr;

std::vector<float> ramp(size_t count, float scale) {
  std::vector<float> values(count);
  for (size_t i = 0; i < count; ++i) values[i] = scale * static_cast<float>(i) - 3;
  return values;
}

LayeredImage four_layers() {
  LayeredImage image;
  image.width = 5;
  image.height = 3;
  image.layers.push_back({"", {"R", "G", "B"}, ramp(45, 0.1f)});
  image.layers.push_back({"albedo", {"R", "G", "B"}, ramp(45, 1e-6f)});
  image.layers.push_back({"depth", {"Z"}, ramp(15, 1e6f)});
  image.layers.push_back({"shading-normal", {"X", "Y", "Z"}, ramp(45, 0.01f)});
  image.attributes = {{"etendue", "{\"seed\": 7}"}, {"title", "\xc3\x89tendue"}};
  return image;
}

Result<LayeredImage> read_bytes(const FileBytes& bytes) {
  const image::ImageFormat* format = image::recognise_format(view(bytes));
  if (!format || !format->decode_layers) return input_error("a.exr: not recognised");
  return format->decode_layers(view(bytes), "a.exr");
}

std::vector<FileBytes> float_samples(std::initializer_list<float> values) {
  std::vector<FileBytes> samples;
  for (const float v : values) samples.push_back(sample(v));
  return samples;
}

TEST(Exr, RoundTripIsExact) {
  const TemporaryFile file("a.exr");
  LayeredImage image = four_layers();
  image.layers[0].pixels[4] = std::numeric_limits<float>::infinity();
  for (const auto write : {image::write_exr, image::write_exr_quickly}) {
    ASSERT_TRUE(write(file.path(), image));
    const auto read = read_exr(file.path());
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->width, 5);
    EXPECT_EQ(read->height, 3);
    EXPECT_EQ(read->attributes, image.attributes);
    ASSERT_EQ(read->layers.size(), image.layers.size());
    for (const Layer& layer : image.layers) {
      const Layer* found = read->find(layer.name);
      ASSERT_NE(found, nullptr) << layer.name;
      EXPECT_EQ(found->channels, layer.channels);
      EXPECT_EQ(found->pixels, layer.pixels);
    }
  }
}

TEST(Exr, RejectsInvalidImages) {
  const TemporaryFile file("a.exr");
  LayeredImage twice = four_layers(), small = four_layers(), reserved = four_layers();
  twice.layers[1].name = "";
  small.layers[1].pixels.pop_back();
  reserved.attributes["compression"] = "none at all";
  EXPECT_FALSE(image::write_exr(file.path(), twice));
  EXPECT_FALSE(image::write_exr(file.path(), small));
  EXPECT_FALSE(image::write_exr(file.path(), reserved));
  EXPECT_FALSE(image::write_exr(file.path(), {}));
  EXPECT_FALSE(image::write_exr(file.folder() / "missing" / "a.exr", four_layers()));
  EXPECT_TRUE(std::filesystem::is_empty(file.folder())) << "a failed write leaves no file";
}

TEST(Exr, FailedWriteKeepsTheExistingFile) {
  const TemporaryFile file("a.exr");
  ASSERT_TRUE(image::write_exr(file.path(), four_layers()));
  LayeredImage bad = four_layers();
  bad.attributes["dataWindow"] = "text";
  EXPECT_FALSE(image::write_exr(file.path(), bad));
  EXPECT_TRUE(read_exr(file.path()));
}

TEST(Exr, ReadsHalfFloatAndUintChannels) {
  // Sorted by name. As half floats, 0x3c00 is 1 and 0xc100 is -2.5.
  const std::vector<ExrChannel> channels{{"B", ExrType::half, {sample(uint16_t{0x3c00})}},
                                         {"G", ExrType::float32, float_samples({0.1f})},
                                         {"R", ExrType::half, {sample(uint16_t{0xc100})}},
                                         {"object.id", ExrType::uint32, {sample(uint32_t{70000})}}};
  const auto image = read_bytes(exr_file(channels, {0, 0, 0, 0}, {0, 0, 0, 0}));
  ASSERT_TRUE(image) << image.error().message;
  const Layer* beauty = image->find("");
  ASSERT_NE(beauty, nullptr);
  EXPECT_EQ(beauty->channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(beauty->pixels, (std::vector<float>{-2.5f, 0.1f, 1}));
  const Layer* object = image->find("object");
  ASSERT_NE(object, nullptr);
  EXPECT_EQ(object->channels, std::vector<std::string>{"id"});
  EXPECT_EQ(object->pixels, std::vector<float>{70000});
  EXPECT_EQ(image->attributes.at("note"), "from the specification");
}

TEST(Exr, ImageIsTheDisplayWindow) {
  // The data window is 2 x 2 pixels at (4, 10). The display window of 2 x 3 pixels at (3, 9) contains its left column.
  const std::vector<ExrChannel> channels{{"Y", ExrType::float32, float_samples({1, 2, 3, 4})}};
  const auto image = read_bytes(exr_file(channels, {4, 10, 5, 11}, {3, 9, 4, 11}));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->width, 2);
  EXPECT_EQ(image->height, 3);
  EXPECT_EQ(image->find("")->pixels, (std::vector<float>{0, 0, 0, 1, 0, 3}));
}

TEST(Exr, NegativeOverscanIsDropped) {
  const std::vector<ExrChannel> channels{{"Y", ExrType::float32, float_samples({1, 2, 3, 4, 5, 6, 7, 8, 9})}};
  const auto image = read_bytes(exr_file(channels, {-1, -1, 1, 1}, {0, 0, 0, 0}));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->find("")->pixels, std::vector<float>{5});
}

TEST(Exr, DisjointWindowsGiveBlack) {
  const std::vector<ExrChannel> channels{{"Y", ExrType::float32, float_samples({1})}};
  const auto image = read_bytes(exr_file(channels, {10, 10, 10, 10}, {0, 0, 1, 0}));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->find("")->pixels, (std::vector<float>{0, 0}));
}

TEST(Exr, EveryTruncationIsAnError) {
  const TemporaryFile file("a.exr");
  ASSERT_TRUE(image::write_exr(file.path(), four_layers()));
  const auto stored = read_file(file.path());
  ASSERT_TRUE(stored);
  const FileBytes whole(reinterpret_cast<const char*>(stored->data()), stored->size());
  ASSERT_TRUE(read_bytes(whole));
  for (size_t size = 0; size < whole.size(); ++size) EXPECT_FALSE(read_bytes(whole.substr(0, size))) << size;
}

TEST(Exr, DamagedBytesDoNotCrash) {
  const std::vector<ExrChannel> channels{{"B", ExrType::float32, float_samples({1, 2})},
                                         {"G", ExrType::float32, float_samples({3, 4})},
                                         {"R", ExrType::float32, float_samples({5, 6})}};
  const FileBytes whole = exr_file(channels, {0, 0, 1, 0}, {0, 0, 1, 0});
  ASSERT_TRUE(read_bytes(whole));
  for (size_t at = 0; at < whole.size(); ++at)
    for (const int mask : {0x01, 0x40, 0x80, 0xff}) {
      FileBytes damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ mask);
      (void)static_cast<bool>(read_bytes(damaged));
    }
}

TEST(Exr, RejectsHugeSizes) {
  const std::vector<ExrChannel> channels{{"R", ExrType::float32, {}}};
  constexpr int32_t kFar = 0x3ffffff0;
  for (const ExrBox box : {ExrBox{-kFar, -kFar, kFar, kFar}, ExrBox{0, 0, 16384, 16383}, ExrBox{5, 0, 4, 0}}) {
    EXPECT_FALSE(read_bytes(exr_header(channels, box, box) + FileBytes(64, '\0')));
    EXPECT_FALSE(read_bytes(exr_header(channels, {0, 0, 0, 0}, box) + FileBytes(64, '\0')));
  }
}

std::string error_of(const FileBytes& file) {
  const auto image = read_bytes(file);
  return image ? "" : image.error().message;
}

// Without these limits, a file of a few hundred bytes takes gigabytes of memory.
TEST(Exr, MemoryIsLimitedByTheLengthOfTheFile) {
  const std::vector<ExrChannel> one{{"R", ExrType::float32, float_samples({1})}};
  const std::string wide = error_of(exr_file(one, {0, 0, 0, 0}, {0, 0, 16383, 4095}));
  EXPECT_NE(wide.find("67108864 pixels, and only 1 of them are stored"), std::string::npos) << wide;
  EXPECT_EQ(error_of(exr_file(one, {0, 0, 0, 0}, {0, 0, 1023, 1023})), "");
  const std::vector<ExrChannel> none{{"R", ExrType::float32, {}}};
  const std::string short_file = error_of(exr_header(none, {0, 0, 8191, 0}, {0, 0, 8191, 0}) + FileBytes(64, '\0'));
  EXPECT_NE(short_file.find("too few for the image size in its header"), std::string::npos) << short_file;
}

// The library allocates the length that an attribute states.
TEST(Exr, LengthsOfAttributesAreChecked) {
  const std::vector<ExrChannel> one{{"R", ExrType::float32, float_samples({1})}};
  const FileBytes whole = exr_file(one, {0, 0, 0, 0}, {0, 0, 0, 0});
  ASSERT_EQ(error_of(whole), "");
  const auto with_length = [&](const FileBytes& attribute, uint32_t length) {
    FileBytes changed = whole;
    const size_t at = changed.find(attribute) + attribute.size();
    for (size_t i = 0; i < 4; ++i) changed[at + i] = static_cast<char>(length >> 8 * i & 255);
    return error_of(changed);
  };
  using namespace std::string_literals;
  const std::string too_long = with_length("lineOrder\0lineOrder\0"s, 0x40000000);
  EXPECT_NE(too_long.find("'lineOrder' of the OpenEXR file is longer than the rest"), std::string::npos) << too_long;
  const std::string wrong = with_length("compression\0compression\0"s, 2);
  EXPECT_NE(wrong.find("does not have the length of its type, 'compression'"), std::string::npos) << wrong;
  EXPECT_NE(with_length("channels\0chlist\0"s, 20), "");
}

TEST(Exr, ErrorsNameTheFile) {
  const TemporaryFile file("a.exr");
  EXPECT_FALSE(read_exr(file.path()));
  EXPECT_FALSE(read_exr(file.folder()));
  ASSERT_TRUE(write_file(file.path(), "not an image..", 13));
  const auto image = read_exr(file.path());
  ASSERT_FALSE(image);
  EXPECT_NE(image.error().message.find(file.path().string()), std::string::npos);
}

TEST(Exr, ReadsReferenceImages) {
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  if (!data) GTEST_SKIP() << "ETENDUE_TEST_DATA is not set";
  size_t found = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
    if (entry.path().extension() != ".exr") continue;
    ++found;
    const auto image = image::read_linear(entry.path());
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->layers.front().channels, (std::vector<std::string>{"R", "G", "B"})) << entry.path();
    double sum = 0;
    for (const float v : image->layers.front().pixels) sum += v;
    EXPECT_TRUE(std::isfinite(sum) && sum > 0) << entry.path();
  }
  if (found == 0) GTEST_SKIP() << "no EXR in " << data;
}

TEST(ExrAttribute, IsReplacedAndRemovedWithoutTouchingThePixels) {
  const std::filesystem::path file = testing::TempDir() + "attribute.exr";
  ASSERT_TRUE(image::write_exr(file, four_layers()));
  for (const char* text : {"first", "a longer text\nwith two lines", ""}) {
    ASSERT_TRUE(image::set_exr_attribute(file, "comments", text));
    const auto read = read_exr(file);
    ASSERT_TRUE(read) << read.error().message;
    const auto found = read->attributes.find("comments");
    EXPECT_EQ(found == read->attributes.end() ? "" : found->second, text);
    EXPECT_EQ(read->attributes.at("title"), "\xc3\x89tendue");
    ASSERT_EQ(read->layers.size(), four_layers().layers.size());
    for (const Layer& layer : four_layers().layers) EXPECT_EQ(read->find(layer.name)->pixels, layer.pixels) << layer.name;
  }
}

TEST(ExrAttribute, BadFilesStayAsTheyAre) {
  const std::filesystem::path file = testing::TempDir() + "bad.exr";
  EXPECT_FALSE(image::set_exr_attribute(testing::TempDir() + "missing.exr", "comments", "text"));
  ASSERT_TRUE(write_file(file, "no image", 8));
  EXPECT_FALSE(image::set_exr_attribute(file, "comments", "text"));
  ASSERT_TRUE(image::write_exr(file, four_layers()));
  const auto whole = read_file(file);
  ASSERT_TRUE(whole && write_file(file, whole->data(), whole->size() - 40));
  const auto before = read_file(file);
  EXPECT_FALSE(image::set_exr_attribute(file, "comments", "text"));
  EXPECT_EQ(*read_file(file), *before);
}

// The library would keep the first part only.
TEST(ExrAttribute, FilesWithSeveralPartsAreRefused) {
  const std::filesystem::path file = testing::TempDir() + "parts.exr";
  std::vector<Imf::Header> headers(2, Imf::Header(2, 2));
  for (size_t i = 0; i < 2; ++i) {
    headers[i].setName("part " + std::to_string(i));
    headers[i].setType(Imf::SCANLINEIMAGE);
    headers[i].channels().insert("Z", Imf::Channel(Imf::FLOAT));
  }
  {
    Imf::MultiPartOutputFile out(file.c_str(), headers.data(), 2);
    std::vector<float> pixels(4, 0.5f);
    for (int i = 0; i < 2; ++i) {
      Imf::FrameBuffer source;
      source.insert("Z", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data()), 4, 8));
      Imf::OutputPart part(out, i);
      part.setFrameBuffer(source);
      part.writePixels(2);
    }
  }
  const auto before = read_file(file);
  const auto written = image::set_exr_attribute(file, "comments", "text");
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("several parts"), std::string::npos) << written.error().message;
  EXPECT_EQ(*read_file(file), *before);
}

}  // namespace
}  // namespace etendue::test
