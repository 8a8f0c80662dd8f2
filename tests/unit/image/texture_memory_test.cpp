// Textures within a memory budget: sizes, and the tiled files of the cache folder.
#include "image/texture_memory.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "image/plugin.h"
#include "spectrum/rgb.h"
#include "unit/image/file_bytes.h"

namespace etendue::test {
namespace {

using image::TiledImage;

TEST(MemorySize, HasUnits) {
  EXPECT_EQ(*image::parse_memory_size("4096"), 4096u);
  EXPECT_EQ(*image::parse_memory_size("512M"), uint64_t{512} << 20);
  EXPECT_EQ(*image::parse_memory_size("1.5g"), uint64_t{3} << 29);
  EXPECT_EQ(*image::parse_memory_size("2T"), uint64_t{2} << 40);
  for (const char* text : {"", "M", "0", "-1G", "1Q", "1GB", "1e30", "nan"})
    EXPECT_FALSE(image::parse_memory_size(text)) << text;
}

// Grey with an odd size, so that levels drop a column and a row.
constexpr int kOddWidth = 131, kOddHeight = 67;

uint8_t grey_at(int x, int y) { return static_cast<uint8_t>(x * 7 + y * 13); }

FileBytes odd_png() {
  std::vector<FileBytes> rows(kOddHeight);
  for (int y = 0; y < kOddHeight; ++y)
    for (int x = 0; x < kOddWidth; ++x) rows[static_cast<size_t>(y)].push_back(static_cast<char>(grey_at(x, y)));
  return png_file(kOddWidth, 8, kGrey, rows);
}

TEST(DecodedSize, FollowsFromTheHeader) {
  EXPECT_EQ(image::decoded_size(view(odd_png()), "a.png"), uint64_t{kOddWidth} * kOddHeight);
  EXPECT_EQ(image::decoded_size(view(png_header(3000, 2000, 16, kTrueColourAlpha) + png_chunk("IDAT", "")), "a.png"),
            uint64_t{3000} * 2000 * 4);
  EXPECT_EQ(image::decoded_size(view("no image"), "a.png"), 0u);
}

class StoredTiles : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto plugin = image::image_plugin(); !plugin) GTEST_SKIP() << plugin.error().message;
    setenv("XDG_CACHE_HOME", folder_.folder().c_str(), 1);
    image::set_texture_memory(1 << 20);
  }
  void TearDown() override { image::set_texture_memory(image::kUnlimitedTextureMemory); }

  size_t stored_files() const {
    size_t count = 0;
    for ([[maybe_unused]] const auto& file :
         std::filesystem::directory_iterator(folder_.folder() / "etendue" / "textures"))
      ++count;
    return count;
  }

  TemporaryFile folder_{"cache"};
};

uint8_t value_at(const TiledImage& image, int level, int x, int y) {
  const Vec2i place(x, y);
  TiledImage::Texels<uint8_t> texels{};
  EXPECT_TRUE(image.read(level, {place, place, place, place}, texels));
  return texels[0][0];
}

TEST_F(StoredTiles, HoldTheImageAndItsMeans) {
  const auto linear = image::stored_tiles(view(odd_png()), "a.png", false);
  ASSERT_TRUE(linear) << linear.error().message;
  const auto srgb = image::stored_tiles(view(odd_png()), "a.png", true);
  ASSERT_TRUE(srgb) << srgb.error().message;
  const TiledImage& image = **linear;
  EXPECT_EQ(image.width, kOddWidth);
  EXPECT_EQ(image.height, kOddHeight);
  EXPECT_EQ(image.channels, 1);
  EXPECT_EQ(image.levels, 8);
  EXPECT_NE(image.hash, (*srgb)->hash);
  for (int y = 0; y < kOddHeight; ++y)
    for (int x = 0; x < kOddWidth; ++x) ASSERT_EQ(value_at(image, 0, x, y), grey_at(x, y)) << x << " " << y;
  for (int y = 0; y < kOddHeight / 2; ++y)
    for (int x = 0; x < kOddWidth / 2; ++x) {
      float sum = 0, linear_sum = 0;
      for (const Vec2i offset : {Vec2i(0, 0), Vec2i(1, 0), Vec2i(0, 1), Vec2i(1, 1)}) {
        const float value = static_cast<float>(grey_at(2 * x + offset.x, 2 * y + offset.y));
        sum += value;
        linear_sum += srgb_to_linear(value / 255);
      }
      ASSERT_NEAR(value_at(image, 1, x, y), sum / 4, 0.51) << x << " " << y;
      ASSERT_NEAR(value_at(**srgb, 1, x, y), 255 * linear_to_srgb(linear_sum / 4), 0.6) << x << " " << y;
    }
}

TEST_F(StoredTiles, ReadNeighboursAcrossTiles) {
  const auto tiles = image::stored_tiles(view(odd_png()), "a.png", false);
  ASSERT_TRUE(tiles) << tiles.error().message;
  TiledImage::Texels<uint8_t> texels{};
  ASSERT_TRUE((*tiles)->read(0, {Vec2i(63, 63), Vec2i(64, 63), Vec2i(63, 64), Vec2i(64, 64)}, texels));
  EXPECT_EQ(texels[0][0], grey_at(63, 63));
  EXPECT_EQ(texels[1][0], grey_at(64, 63));
  EXPECT_EQ(texels[2][0], grey_at(63, 64));
  EXPECT_EQ(texels[3][0], grey_at(64, 64));
}

TEST_F(StoredTiles, AreStoredOnce) {
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(image::stored_tiles(view(odd_png()), "a.png", false));
  EXPECT_EQ(stored_files(), 1u);
}

TEST_F(StoredTiles, GiveTheImageBack) {
  const auto tiles = image::stored_tiles(view(odd_png()), "a.png", true);
  ASSERT_TRUE(tiles) << tiles.error().message;
  const auto pixels = (*tiles)->pixels();
  ASSERT_TRUE(pixels) << pixels.error().message;
  EXPECT_EQ(pixels->bytes, image::decode_image(view(odd_png()), "a.png")->bytes);
}

TEST_F(StoredTiles, KeepFloats) {
  const FileBytes half = sample(0.5f), two = sample(2.0f);
  const FileBytes file =
      exr_file({{"B", ExrType::float32, {half}}, {"G", ExrType::float32, {two}}, {"R", ExrType::float32, {half}}},
               {0, 0, 0, 0}, {0, 0, 0, 0});
  const auto tiles = image::stored_tiles(view(file), "a.exr", true);
  ASSERT_TRUE(tiles) << tiles.error().message;
  TiledImage::Texels<float> texels{};
  ASSERT_TRUE((*tiles)->read(0, {Vec2i(0), Vec2i(0), Vec2i(0), Vec2i(0)}, texels));
  EXPECT_EQ(texels[3][0], 0.5f);
  EXPECT_EQ(texels[3][1], 2.0f);
}

TEST_F(StoredTiles, DamagedImagesAreErrors) {
  const auto tiles = image::stored_tiles(view(odd_png().substr(0, 200)), "a.png", false);
  ASSERT_FALSE(tiles);
  EXPECT_EQ(tiles.error().message.find("a.png: "), 0u) << tiles.error().message;
  EXPECT_EQ(stored_files(), 0u);
}

}  // namespace
}  // namespace etendue::test
