// Look-ups in tiled images equal those in memory at level 0, and read coarser levels for wider footprints.
#include <gtest/gtest.h>

#include "image/tiled_image.h"
#include "material/surface_material.h"
#include "support/gltf_cases.h"

namespace etendue::test {
namespace {

// Serves an image in memory as tiles. Each further level is constant: its number.
class MemoryTiles final : public image::TiledImage {
 public:
  explicit MemoryTiles(std::shared_ptr<const image::Image> image) : image_(std::move(image)) {
    width = image_->width;
    height = image_->height;
    channels = image_->channels;
    type = image_->type;
    levels = 4;
  }
  bool read(int level, const std::array<Vec2i, 4>& positions, Texels<uint8_t>& texels) const override {
    return copy(image_->bytes, level, positions, texels);
  }
  bool read(int level, const std::array<Vec2i, 4>& positions, Texels<float>& texels) const override {
    return copy(image_->floats, level, positions, texels);
  }
  Result<image::Image> pixels() const override { return *image_; }

 private:
  template <class Value>
  bool copy(const std::vector<Value>& values, int level, const std::array<Vec2i, 4>& positions,
            Texels<Value>& texels) const {
    for (size_t i = 0; i < 4; ++i)
      for (int c = 0; c < channels; ++c) {
        const auto at = static_cast<size_t>((positions[i].y * width + positions[i].x) * channels + c);
        texels[i][static_cast<size_t>(c)] = level > 0 ? static_cast<Value>(level) : values.at(at);
      }
    return true;
  }
  std::shared_ptr<const image::Image> image_;
};

std::shared_ptr<const image::Image> random_image(int channels, image::PixelType type) {
  auto image = std::make_shared<image::Image>();
  image->width = 16;
  image->height = 9;
  image->channels = channels;
  image->type = type;
  Random random(3);
  for (int i = 0; i < image->width * image->height * channels; ++i)
    if (type == image::PixelType::byte8)
      image->bytes.push_back(static_cast<uint8_t>(random.uniform() * 255));
    else
      image->floats.push_back(random.uniform() * 3);
  return image;
}

TEST(TiledTextures, EqualImagesInMemory) {
  Random random(5);
  for (const auto type : {image::PixelType::byte8, image::PixelType::float32})
    for (int channels = 1; channels <= 4; ++channels)
      for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
        for (const bool nearest : {false, true}) {
          Texture memory;
          memory.image = random_image(channels, type);
          memory.wrap_u = memory.wrap_v = wrap;
          memory.nearest = nearest;
          Texture tiled = memory;
          tiled.image = nullptr;
          tiled.tiles = std::make_shared<MemoryTiles>(memory.image);
          for (int i = 0; i < 200; ++i) {
            const Vec2 uv(random.uniform() * 6 - 3, random.uniform() * 6 - 3);
            for (const Encoding encoding : {Encoding::srgb, Encoding::linear})
              ASSERT_EQ(lookup(memory, encoding, uv), lookup(tiled, encoding, uv));
          }
        }
}

TEST(TiledTextures, FootprintsSelectTheLevel) {
  Texture texture;
  texture.tiles = std::make_shared<MemoryTiles>(random_image(1, image::PixelType::float32));
  const auto level = [&](float texels) { return lookup(texture, Encoding::linear, Vec2(0.3f, 0.6f), texels / 16).x; };
  EXPECT_EQ(level(2), 1);
  EXPECT_EQ(level(3.9f), 1);
  EXPECT_EQ(level(4), 2);
  EXPECT_EQ(level(8), 3);
  EXPECT_EQ(level(1e30f), 3) << "the last level";
}

TEST(TiledTextures, MaterialsUseThem) {
  std::vector<Texture> textures(1);
  textures[0].tiles = std::make_shared<MemoryTiles>(random_image(3, image::PixelType::byte8));
  Material material;
  material.base_color_texture.texture = 0;
  material.base_color_texture.scale = Vec2(0.5f, 4);
  const SurfaceMaterial surface(material, textures);
  EXPECT_TRUE(surface.has_textures && surface.has_tiled_textures);
  TexturePoint point;
  point.footprint = 2.0f / 16 / 0.5f;
  EXPECT_NEAR(surface.base_color_at(point).x, srgb_to_linear(1 / 255.0f), 1e-6f) << "level 1, by the smaller scale";
}

}  // namespace
}  // namespace etendue::test
