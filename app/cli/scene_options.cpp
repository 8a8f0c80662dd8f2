#include "scene_options.h"

#include <cstdio>

#include "image/plugin.h"
#include "image/texture_memory.h"
#include "render/scene_warnings.h"
#include "render/session_file.h"
#include "scene/builtin/builtin.h"

namespace etendue::cli {

CommandOption scene_option(std::string& target, bool required) {
  return {.names = "scene",
          .target = &target,
          .doc = "A glTF file (.gltf or .glb), a session (.etendue), or a built-in scene: " + scene::builtin_names(),
          .required = required};
}

CommandOption camera_option(std::string& target) {
  return {.names = "--camera", .target = &target, .doc = "Camera of the scene, by name or index"};
}

CommandOption size_option(std::string& target) {
  return {.names = "--size", .target = &target, .doc = "Size of the image in pixels, WIDTHxHEIGHT"};
}

CommandOption environment_option(std::string& target) {
  return {.names = "--env",
          .target = &target,
          .doc = "Environment map: an .hdr, .exr or other image file, or studio, overcast, sunset, sky or uniform"};
}

CommandOption paths_option(std::string& target) {
  return {.names = "--paths",
          .target = &target,
          .doc = "Path expression: restricts the image to matching light paths, e.g. 'E(D|G)L' or 'EDS+L'"};
}

CommandOption error_measure_option(std::string& target, const std::string& doc) {
  std::vector<std::string> names;
  for (const Option& option : Options<film::ErrorMeasure>::kOptions) names.emplace_back(option.name);
  return {.names = "--error-measure", .target = &target, .doc = doc, .choices = names};
}

film::ErrorMeasure measure_of(const std::string& name) {
  const auto& options = Options<film::ErrorMeasure>::kOptions;
  for (size_t i = 0; i < options.size(); ++i)
    if (name == options[i].name) return film::kErrorMeasures[i];
  return film::ErrorMeasure::rmse;
}

CommandOption denoiser_option(std::string& target) {
  std::vector<std::string> names;
  for (const Option& option : Options<render::Denoiser>::kOptions) names.emplace_back(option.name);
  return {.names = "--denoiser",
          .target = &target,
          .doc =
              "Denoiser of --denoise: regression on features; oidn, Open Image Denoise, if it is installed; auto, the "
              "latter if it is installed",
          .choices = names};
}

CommandOption set_option(std::vector<std::string>& target) {
  return {.names = "--set", .target = &target, .doc = "NAME=VALUE: sets a parameter; may be repeated"};
}

CommandOption threads_option(int& target) {
  return {.names = "--threads",
          .target = &target,
          .doc = "Number of rendering threads; 0: one per hardware thread",
          .bounds = between(0, 1024)};
}

CommandOption json_flag(bool& target) { return {.names = "--json", .target = &target, .doc = "Print JSON"}; }

CommandOption texture_memory_option(std::string& target) {
  return {.names = "--texture-memory",
          .target = &target,
          .doc =
              "Memory for textures, e.g. 512M or 2G: a scene whose textures need more reads them from mip-mapped "
              "files; without it all are in memory"};
}

Result<void> set_texture_memory(const std::string& size) {
  if (size.empty()) return {};
  const auto bytes = image::parse_memory_size(size);
  if (!bytes) return usage_error("--texture-memory: " + bytes.error().message);
  if (const auto plugin = image::image_plugin(); !plugin)
    return usage_error("--texture-memory: " + plugin.error().message);
  image::set_texture_memory(*bytes);
  return {};
}

Result<void> set_parameter(render::Document& document, const std::string& name, const std::string& value) {
  auto changed = render::with_text(document, name, value);
  if (!changed) return changed.error();
  document = std::move(*changed);
  return {};
}

Result<Vec2i> parse_size(const std::string& text) {
  int width = 0, height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2)
    return usage_error("--size: '" + text + "' is not a size; give WIDTHxHEIGHT, for example 1280x720");
  if (width < 1 || height < 1 || width > 16384 || height > 16384)
    return usage_error("--size: '" + text + "' is out of range; give a size from 1x1 to 16384x16384");
  return Vec2i(width, height);
}

Result<void> set_size(render::Document& document, const std::string& text) {
  if (text.empty()) return {};
  const auto size = parse_size(text);
  if (!size) return size.error();
  if (auto r = set_parameter(document, "film.width", std::to_string(size->x)); !r) return r;
  return set_parameter(document, "film.height", std::to_string(size->y));
}

Result<void> set_environment(render::Document& document, const std::string& file) {
  if (file.empty()) return {};
  auto changed = render::with_environment(document, file);
  if (!changed) return changed.error();
  document = std::move(*changed);
  return {};
}

Result<SettingText> split_setting(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos) return usage_error("--set: '" + text + "' has no '='; give NAME=VALUE");
  return SettingText{text.substr(0, equals), text.substr(equals + 1)};
}

Result<std::vector<Setting>> parse_settings(const std::vector<std::string>& texts,
                                            std::span<const ParameterInfo> parameters, const std::string& owner,
                                            const std::string& list_command) {
  std::vector<Setting> settings;
  for (const std::string& text : texts) {
    const auto setting = split_setting(text);
    if (!setting) return setting.error();
    const ParameterInfo* info = find_parameter(parameters, setting->name);
    if (!info) return usage_error(owner + " has no parameter '" + setting->name + "'; see " + list_command);
    auto value = parse_value(*info, setting->value);
    if (!value) return value.error();
    settings.push_back({setting->name, *value});
  }
  return settings;
}

Result<void> set_parameters(render::Document& document, const std::vector<std::string>& settings) {
  for (const auto& text : settings) {
    const auto setting = split_setting(text);
    if (!setting) return setting.error();
    if (auto r = set_parameter(document, setting->name, setting->value); !r) return r;
  }
  return {};
}

Result<render::Document> open_scene_or_session(const std::string& file, const std::string& camera) {
  if (!file.ends_with(render::kSessionExtension)) return render::new_document(file, camera);
  auto document = render::read_session_file(file);
  if (!document || camera.empty()) return document;
  const auto chosen = scene::choose_camera(*document->scene, camera);
  if (!chosen) return usage_error(file + ": " + chosen.error().message);
  document->camera = *chosen;
  document->camera_name = camera;
  return document;
}

Result<render::Document> open_document(const SceneArguments& arguments) {
  auto document = open_scene_or_session(arguments.scene, arguments.camera);
  if (!document) return document;
  if (auto r = set_size(*document, arguments.size); !r) return r.error();
  if (auto r = set_environment(*document, arguments.environment); !r) return r.error();
  if (auto r = set_parameters(*document, arguments.settings); !r) return r.error();
  if (!arguments.paths.empty())
    if (auto r = set_parameter(*document, "film.paths", arguments.paths); !r) return r.error();
  if (document->automatic.is_pending())
    return usage_error(
        "render.integrator: only etendue render and the viewer choose the integrator automatically; name an integrator "
        "here, or rank them with etendue advise");
  return document;
}

void print_warnings(const render::Document& document) {
  for (const auto& warning : render::current_warnings(document))
    std::fprintf(stderr, "etendue: %s: %s\n", document.scene_name.c_str(), warning.c_str());
}

}  // namespace etendue::cli
