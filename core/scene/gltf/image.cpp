// Pictures: found in files, data URIs and buffer views, decoded once each.                        glTF 2.0, section 3.8
#include "scene/gltf/import.h"

namespace etendue::scene::gltf {
namespace {

// The picture that a texture shows, -1 if none can be read. A WebP copy is what its author prefers.
int image_of(const tinygltf::Texture& texture) {
  if (const auto* webp = extension_of(texture.extensions, "EXT_texture_webp"))
    if (const int source = index_of(*webp, "source", -1); source >= 0) return source;
  return texture.source;
}

}  // namespace

std::vector<ImageTask> image_tasks(const Document& document) {
  std::vector<bool> shown(document.images.size(), false);
  for (size_t t = 0; t < document.model.textures.size(); ++t)
    if (const int image = image_of(document.model.textures[t]); image >= 0)
      shown[checked_index(image, shown.size(), at("textures", t) + ".source", "images")] = true;
  std::vector<ImageTask> tasks;
  for (size_t i = 0; i < shown.size(); ++i)
    if (shown[i]) tasks.push_back({i, nullptr, ""});
  return tasks;
}

void read_picture(const Document& document, ImageTask& task) {
  const std::string name = image_name(document, task.image);
  const ImageBytes bytes = read_image(document, task.image);
  if (!bytes.problem.empty()) {
    task.warning = name + ": " + bytes.problem + "; the factors alone are used";
    return;
  }
  auto picture = image::decode_image(bytes.bytes, name);
  if (picture)
    task.picture = std::make_shared<const image::Image>(std::move(*picture));
  else
    task.warning = picture.error().message + "; the factors alone are used";
}

void place_pictures(const Document& document, const std::vector<ImageTask>& tasks, Scene& scene) {
  std::vector<std::shared_ptr<const image::Image>> pictures(document.images.size());
  for (const ImageTask& task : tasks) pictures[task.image] = task.picture;
  for (size_t t = 0; t < scene.textures.size(); ++t) {
    const int image = image_of(document.model.textures[t]);
    if (image >= 0)
      scene.textures[t].image = pictures[static_cast<size_t>(image)];
    else
      scene.warnings.push_back(at("textures", t) +
                               ": has no picture in a format that can be read; the factors alone are used");
  }
}

}  // namespace etendue::scene::gltf
