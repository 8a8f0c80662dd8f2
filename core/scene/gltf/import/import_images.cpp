// Imports images from files, data URIs and buffer views. Each image is decoded once.              glTF 2.0, section 3.8
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

std::vector<ImageTask> image_tasks(const InputFile& input) {
  std::vector<bool> used(input.images.size(), false);
  for (size_t t = 0; t < input.model.textures.size(); ++t)
    if (const int image = image_of(input.model.textures[t]); image >= 0)
      used[checked_index(image, used.size(), at("textures", t) + ".source", "images")] = true;
  std::vector<ImageTask> tasks;
  for (size_t i = 0; i < used.size(); ++i)
    if (used[i]) tasks.push_back({i, nullptr, ""});
  return tasks;
}

void read_image_task(const InputFile& input, ImageTask& task) {
  const std::string name = image_name(input, task.image);
  const ImageBytes bytes = read_image(input, task.image);
  if (!bytes.problem.empty()) {
    task.warning = name + ": " + bytes.problem + "; constant factors are used instead";
    return;
  }
  auto pixels = image::decode_image(bytes.bytes, name);
  if (pixels)
    task.pixels = std::make_shared<const image::Image>(std::move(*pixels));
  else
    task.warning = pixels.error().message + "; constant factors are used instead";
}

void add_images(const InputFile& input, const std::vector<ImageTask>& tasks, Scene& scene) {
  std::vector<std::shared_ptr<const image::Image>> images(input.images.size());
  for (const ImageTask& task : tasks) images[task.image] = task.pixels;
  for (size_t t = 0; t < scene.textures.size(); ++t) {
    const int image = image_of(input.model.textures[t]);
    if (image >= 0)
      scene.textures[t].image = images[static_cast<size_t>(image)];
    else
      scene.warnings.push_back(
          at("textures", t) +
          ": has no image in a supported format (PNG, JPEG, WebP); constant factors are used instead");
  }
}

}  // namespace etendue::scene::gltf
