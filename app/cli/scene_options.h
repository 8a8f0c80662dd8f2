// Options that many subcommands share: the scene, its settings, the seed and the number of threads.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "command.h"
#include "render/document.h"

namespace etendue::cli {

// Empty texts leave the document as it is.
struct SceneArguments {
  std::string scene, camera, size, environment, paths;
  std::vector<std::string> settings;  // NAME=VALUE
};

CommandOption scene_option(std::string& target, bool required = true);
CommandOption camera_option(std::string& target);
CommandOption size_option(std::string& target);
CommandOption environment_option(std::string& target);
CommandOption paths_option(std::string& target);
// Stores the name of a measure of film/error_measure.h; `measure_of` converts it.
CommandOption error_measure_option(std::string& target, const std::string& doc);
film::ErrorMeasure measure_of(const std::string& name);
// Stores the name of a denoiser (render/denoised_image.h).
CommandOption denoiser_option(std::string& target);
CommandOption set_option(std::vector<std::string>& target);
template <class Integer>
CommandOption seed_option(Integer& target) {
  return {.names = "--seed",
          .target = &target,
          .doc = "Seed of the random numbers; another seed gives independent noise",
          .bounds = kNonNegative};
}
CommandOption threads_option(int& target);
CommandOption json_flag(bool& target);
// The budget for textures of all scenes that the command opens; `set_texture_memory` applies it.
CommandOption texture_memory_option(std::string& target);
Result<void> set_texture_memory(const std::string& size);

Result<void> set_parameter(render::Document& document, const std::string& name, const std::string& value);
Result<void> set_size(render::Document& document, const std::string& size);  // "1280x720"
Result<void> set_environment(render::Document& document, const std::string& file);
Result<void> set_parameters(render::Document& document, const std::vector<std::string>& settings);  // "name=value"

// The two parts of "NAME=VALUE".
struct SettingText {
  std::string name, value;
};
Result<SettingText> split_setting(const std::string& text);
// Texts "NAME=VALUE" as values of these parameters. Errors name their owner, "the sampler 'halton'", and the command
// that lists them.
Result<std::vector<Setting>> parse_settings(const std::vector<std::string>& texts,
                                            std::span<const ParameterInfo> parameters, const std::string& owner,
                                            const std::string& list_command);

// The size in a text like "1280x720". A size that an image cannot have is a usage error.
Result<Vec2i> parse_size(const std::string& text);

// Opens a scene, or a session that the viewer has saved, with this camera if one is named.
Result<render::Document> open_scene_or_session(const std::string& file, const std::string& camera);

// Opens a scene and applies the arguments in the order size, environment, settings, paths. The integrator "auto" is a
// usage error.
Result<render::Document> open_document(const SceneArguments& arguments);

// Prints what the importer had to change or leave out, one line each, on standard error.
void print_warnings(const render::Document& document);

}  // namespace etendue::cli
