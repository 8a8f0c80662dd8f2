// Exports textures, samplers, and images as PNG.
#include "image/tiled_image.h"
#include "scene/gltf/color_textures.h"
#include "scene/gltf/export/output_file.h"
#include "scene/gltf/parallel_jobs.h"
#include "spectrum/rgb.h"

namespace etendue::scene::gltf {
namespace {

int wrap_code(Wrap wrap) {
  switch (wrap) {
    case Wrap::clamp:
      return TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    case Wrap::mirror:
      return TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT;
    default:
      return TINYGLTF_TEXTURE_WRAP_REPEAT;
  }
}

Json sampler_of(const Texture& texture) {
  Json sampler = Json::object();
  if (texture.wrap_u != Wrap::repeat) sampler["wrapS"] = wrap_code(texture.wrap_u);
  if (texture.wrap_v != Wrap::repeat) sampler["wrapT"] = wrap_code(texture.wrap_v);
  if (texture.nearest) sampler["magFilter"] = TINYGLTF_TEXTURE_FILTER_NEAREST;
  return sampler;
}

// Encodes a linear float image as sRGB, except for its alpha channel.
image::Image encoded_as_srgb(image::Image pixels) {
  const auto channels = static_cast<size_t>(pixels.channels);
  const bool alpha = channels % 2 == 0;
  for (size_t i = 0; i < pixels.floats.size(); ++i)
    if (!alpha || i % channels + 1 != channels) pixels.floats[i] = linear_to_srgb(pixels.floats[i]);
  return pixels;
}

struct ImageFile {
  std::shared_ptr<const image::Image> pixels;
  std::shared_ptr<const image::TiledImage> tiles;  // if `pixels` is null
  bool srgb = false;
  std::string name;
  std::vector<std::byte> png;
};

image::Image pixels_of_tiles(const ImageFile& image) {
  auto pixels = image.tiles->pixels();
  if (!pixels) throw FileError{image.name + ": " + pixels.error().message};
  return std::move(*pixels);
}

void encode(ImageFile& image) {
  image::Image stored;
  if (!image.pixels) stored = pixels_of_tiles(image);
  const image::Image& pixels = image.pixels ? *image.pixels : stored;
  const bool floats = pixels.type == image::PixelType::float32;
  auto png = floats && image.srgb ? image::encode_png(encoded_as_srgb(pixels)) : image::encode_png(pixels);
  if (!png) throw FileError{image.name + ": " + png.error().message};
  image.png = std::move(*png);
}

}  // namespace

void export_textures(OutputFile& out) {
  std::vector<ImageFile> images;
  std::map<std::pair<const void*, bool>, size_t> image_index;
  std::map<std::string, int> samplers;
  const std::set<int> colors = color_textures(out.scene);
  for (size_t t = 0; t < out.scene.textures.size(); ++t) {
    const Texture& texture = out.scene.textures[t];
    Json to = Json::object();
    put_name(to, texture.name);
    if (const Json sampler = sampler_of(texture); !sampler.empty()) {
      const auto [place, added] = samplers.try_emplace(sampler.dump(), 0);
      if (added) place->second = out.add("samplers", sampler);
      to["sampler"] = place->second;
    }
    if (texture.image || texture.tiles) {
      const auto type = texture.image ? texture.image->type : texture.tiles->type;
      const void* shared = texture.image ? static_cast<const void*>(texture.image.get()) : texture.tiles.get();
      const bool floats = type == image::PixelType::float32;
      const bool srgb = floats && colors.contains(static_cast<int>(t));
      const auto [place, added] = image_index.try_emplace({shared, srgb}, images.size());
      if (added) images.push_back({texture.image, texture.tiles, srgb, at("textures", t), {}});
      if (added && floats)
        out.warnings.push_back(at("textures", t) +
                               ": the floating-point image was clamped to [0, 1] and stored with 16 bits");
      to["source"] = place->second;
    }
    out.add("textures", std::move(to));
  }
  run_jobs(
      images.size(), [&](size_t i) { encode(images[i]); }, [](float) { return true; });
  for (ImageFile& image : images) out.images.push_back(std::move(image.png));
}

}  // namespace etendue::scene::gltf
