#include "scene/environment_file.h"

#include <cmath>

#include "base/similar_name.h"
#include "light/environments/builtin_environment.h"

namespace etendue::scene {

Result<std::shared_ptr<const image::Image>> load_environment_map(const std::filesystem::path& file) {
  auto source = image::read_linear(file);
  if (!source) return source.error();
  const image::Layer* beauty = source->find("");
  if (!beauty || beauty->channels.size() < 3)
    return input_error(
        file.string() +
        ": has no RGB channels; an environment map has to be an equirectangular RGB image (.hdr or .exr)");
  auto map = std::make_shared<image::Image>();
  map->width = source->width;
  map->height = source->height;
  map->channels = 3;
  map->type = image::PixelType::float32;
  const size_t stride = beauty->channels.size();
  map->floats.reserve(static_cast<size_t>(map->width) * static_cast<size_t>(map->height) * 3);
  for (size_t i = 0; i + stride <= beauty->pixels.size(); i += stride)
    for (size_t c = 0; c < 3; ++c) {
      const float v = beauty->pixels[i + c];
      map->floats.push_back(std::isfinite(v) && v > 0 ? v : 0.0f);
    }
  return std::shared_ptr<const image::Image>(std::move(map));
}

Result<Environment> load_environment(const std::string& file_or_name) {
  if (const BuiltinEnvironment* builtin = find_builtin_environment(file_or_name)) return make_environment(*builtin);
  const std::filesystem::path file(file_or_name);
  std::error_code ignored;
  if (!file.has_extension() && !file.has_parent_path() && !std::filesystem::exists(file, ignored)) {
    std::vector<std::string> names;
    std::string list;
    for (const BuiltinEnvironment& builtin : builtin_environments()) {
      names.emplace_back(builtin.name);
      list += (list.empty() ? "" : ", ") + names.back();
    }
    return input_error("there is no built-in environment '" + file_or_name + "'; use an image file, or one of " + list +
                       did_you_mean(file_or_name, names));
  }
  auto map = load_environment_map(file_or_name);
  if (!map) return map.error();
  return Environment{.map = *map, .file = file_or_name, .tint = Rgb(1)};
}

}  // namespace etendue::scene
