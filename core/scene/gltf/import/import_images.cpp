// Imports images from files, data URIs and buffer views. Each image is decoded once.              glTF 2.0, section 3.8
#include <map>
#include <set>

#include "image/texture_memory.h"
#include "scene/gltf/color_textures.h"
#include "scene/gltf/import/importers.h"

namespace etendue::scene::gltf {
namespace {

// The image of a texture; -1 if it has none in a supported format. EXT_texture_webp takes precedence.
int image_of(const tinygltf::Texture& texture) {
  if (const auto* webp = find_extension(texture.extensions, "EXT_texture_webp"))
    if (const int source = index_or(*webp, "source", -1); source >= 0) return source;
  return texture.source;
}

}  // namespace

std::vector<ImageTask> image_tasks(const InputFile& input, const Scene& scene) {
  const std::set<int> colors = color_textures(scene);
  std::map<size_t, bool> used;  // whether an image is read as colours
  for (size_t t = 0; t < input.model.textures.size(); ++t)
    if (const int image = image_of(input.model.textures[t]); image >= 0) {
      const size_t index = checked_index(image, input.images.size(), at("textures", t) + ".source", "images");
      used[index] = used[index] || colors.contains(static_cast<int>(t));
    }
  std::vector<ImageTask> tasks;
  for (const auto& [image, srgb] : used) tasks.push_back({.image = image, .srgb = srgb});
  return tasks;
}

bool exceed_texture_memory(const InputFile& input, const std::vector<ImageTask>& tasks) {
  const uint64_t budget = image::texture_memory();
  if (budget == image::kUnlimitedTextureMemory) return false;
  uint64_t total = 0;
  for (const ImageTask& task : tasks)
    total += image::decoded_size(read_image(input, task.image).bytes, image_name(input, task.image));
  return total > budget;
}

void read_image_task(const InputFile& input, bool tiled, ImageTask& task) {
  const std::string name = image_name(input, task.image);
  const ImageBytes bytes = read_image(input, task.image);
  if (!bytes.problem.empty()) {
    task.warning = name + ": " + bytes.problem + "; constant factors are used instead";
    return;
  }
  if (tiled) {
    auto tiles = image::stored_tiles(bytes.bytes, name, task.srgb);
    if (tiles)
      task.tiles = std::move(*tiles);
    else
      task.warning = tiles.error().message + "; constant factors are used instead";
    return;
  }
  auto pixels = image::decode_image(bytes.bytes, name);
  if (pixels)
    task.pixels = std::make_shared<const image::Image>(std::move(*pixels));
  else
    task.warning = pixels.error().message + "; constant factors are used instead";
}

void add_images(const InputFile& input, const std::vector<ImageTask>& tasks, Scene& scene) {
  std::vector<const ImageTask*> images(input.images.size());
  for (const ImageTask& task : tasks) images[task.image] = &task;
  size_t basis_universal = 0;  // textures with images in this format only
  for (size_t t = 0; t < scene.textures.size(); ++t) {
    const int image = image_of(input.model.textures[t]);
    if (image >= 0) {
      scene.textures[t].image = images[static_cast<size_t>(image)]->pixels;
      scene.textures[t].tiles = images[static_cast<size_t>(image)]->tiles;
    } else if (find_extension(input.model.textures[t].extensions, kBasisUniversal)) {
      ++basis_universal;
    } else {
      scene.warnings.push_back(at("textures", t) + ": has no image; constant factors are used instead");
    }
  }
  if (basis_universal > 0)
    scene.warnings.push_back(
        "the format KTX 2 (Basis Universal) is not supported; textures without an image in another format: " +
        std::to_string(basis_universal) + "; constant factors are used instead");
}

}  // namespace etendue::scene::gltf
