#include "viewer/state/preferences.h"

#include <algorithm>
#include <array>

#include "light/environments/builtin_environment.h"
#include "viewer/state/settings.h"

namespace etendue::viewer {
namespace {

constexpr std::array<Option, 2> kThemes{{{"dark", "Dark"}, {"light", "Light"}}};

// As steps, because each change loads the fonts again.
constexpr std::array<Option, 8> kScales{{{"automatic", "Automatic"},
                                         {"0.75", "75 %"},
                                         {"1", "100 %"},
                                         {"1.25", "125 %"},
                                         {"1.5", "150 %"},
                                         {"2", "200 %"},
                                         {"2.5", "250 %"},
                                         {"3", "300 %"}}};

size_t index_of_scale(float scale) {
  for (size_t i = 1; i < kScales.size(); ++i)
    if (std::stof(kScales[i].name) == scale) return i;
  return 0;
}

std::vector<Option> environment_options() {
  std::vector<Option> options;
  for (const auto& environment : builtin_environments()) options.push_back({environment.name, environment.label});
  return options;
}

size_t index_of_environment(const std::string& name) {
  const auto all = builtin_environments();
  for (size_t i = 0; i < all.size(); ++i)
    if (name == all[i].name) return i;
  return 0;
}

ParameterInfo font_size(const Settings& settings) {
  return describe(Number<int>{"preferences.font-size",
                              "Font size",
                              static_cast<int>(settings.font_size),
                              {static_cast<int>(kMinFontSize), static_cast<int>(kMaxFontSize)},
                              "Height of text before the scale is applied",
                              "px"});
}

ParameterInfo thread_count(const Settings& settings) {
  return describe(Number<int>{"preferences.threads",
                              "Threads",
                              settings.threads,
                              {0, kMaxThreads},
                              "Rendering threads; 0: one per hardware thread. Takes effect at the next start"});
}

// A folder that can be chosen.
struct FolderPreference {
  const char* name;
  const char* label;
  const char* doc;
  std::string Settings::*folder;
  std::string fallback;  // what is used while the folder is empty
};

std::vector<FolderPreference> folders() {
  const std::string last = "Folder of the last file";
  return {{"preferences.snapshot-folder", "Snapshot folder", "Folder to which Save snapshot writes its images",
           &Settings::snapshot_folder, default_snapshot_folder().string()},
          {"preferences.material-folder", "Material folder", "Folder of the material library",
           &Settings::material_folder, default_material_folder().string()},
          {"preferences.scene-folder", "Scene folder", "Folder in which the dialog for opening scenes starts",
           &Settings::scene_folder, last},
          {"preferences.environment-folder", "Environment folder",
           "Folder in which the dialog for environment maps starts", &Settings::environment_folder, last}};
}

ParameterInfo describe_folder(const FolderPreference& preference, const Settings& settings) {
  return describe(Text{.name = preference.name,
                       .label = preference.label,
                       .value = settings.*preference.folder,
                       .doc = preference.doc,
                       .validate = [](std::string_view) { return Result<void>(); },
                       .presets = {{"", preference.fallback.c_str()}}});
}

}  // namespace

std::vector<ParameterInfo> interface_preferences(const Settings& settings) {
  return {describe_choice("preferences.theme", "Theme", "Colours of the interface", kThemes, settings.dark ? 0 : 1),
          describe_choice("preferences.scale", "UI scale",
                          "Size of the interface. Automatic: from the resolution of the display", kScales,
                          index_of_scale(settings.ui_scale)),
          font_size(settings),
          describe(Toggle{"preferences.welcome", "Show the welcome page", settings.show_welcome,
                          "Shows built-in scenes and recent files when the viewer is started without a scene"}),
          describe(Toggle{"preferences.timing", "Show details in the status bar", settings.show_details,
                          "Shows the rendering speed, the memory, the features in use, and the share of the time that "
                          "drawing the interface takes"})};
}

std::vector<ParameterInfo> rendering_preferences(const Settings& settings) {
  return {
      thread_count(settings),
      describe_choice("preferences.environment", "Default environment",
                      "Lights scenes without lights of their own, from the next scene on", environment_options(),
                      index_of_environment(settings.environment)),
      describe(Toggle{"preferences.automatic", "Automatic integrator", settings.automatic_integrator,
                      "Short pilot renderings choose the integrator a moment after a scene was opened; otherwise "
                      "path tracing. Sessions and snapshots keep their own"}),
      describe(Toggle{"preferences.snapshot-samples", "Samples in snapshots", settings.snapshots_have_samples,
                      "Keeps the samples of a snapshot in a second file, from which the rendering continues. It has "
                      "56 bytes per pixel or more"}),
      describe(Choice<render::Denoiser>{"preferences.denoiser", "Denoiser", settings.denoiser,
                                        "Filter of View > Denoised. Automatic: Open Image Denoise if its library is "
                                        "installed, else regression on features"})};
}

std::vector<ParameterInfo> folder_preferences(const Settings& settings) {
  std::vector<ParameterInfo> list;
  for (const FolderPreference& preference : folders()) list.push_back(describe_folder(preference, settings));
  return list;
}

std::vector<ParameterInfo> all_preferences(const Settings& settings) {
  std::vector<ParameterInfo> list = interface_preferences(settings);
  for (const auto& section : {rendering_preferences(settings), folder_preferences(settings)})
    list.insert(list.end(), section.begin(), section.end());
  return list;
}

std::optional<Value> default_preference(const std::string& name) {
  if (!name.starts_with("preferences.")) return std::nullopt;
  const auto list = all_preferences(Settings());
  const ParameterInfo* info = find_parameter(list, name);
  return info ? std::optional(info->default_value) : std::nullopt;
}

void assign_preference(Settings& settings, const std::string& name, const Value& value) {
  if (name == "preferences.theme") settings.dark = std::get<std::string>(value) == kThemes[0].name;
  if (name == "preferences.scale") {
    const auto& scale = std::get<std::string>(value);
    settings.ui_scale = scale == kScales[0].name ? 0 : std::stof(scale);
  }
  if (name == "preferences.font-size") settings.font_size = static_cast<float>(std::get<int64_t>(value));
  if (name == "preferences.welcome") settings.show_welcome = std::get<bool>(value);
  if (name == "preferences.timing") settings.show_details = std::get<bool>(value);
  if (name == "preferences.automatic") settings.automatic_integrator = std::get<bool>(value);
  if (name == "preferences.snapshot-samples") settings.snapshots_have_samples = std::get<bool>(value);
  if (name == "preferences.denoiser") {
    Choice<render::Denoiser> choice{"preferences.denoiser", "", settings.denoiser, ""};
    assign(choice, value);
    settings.denoiser = choice.value;
  }
  if (name == "preferences.threads") settings.threads = static_cast<int>(std::get<int64_t>(value));
  if (name == "preferences.environment") settings.environment = std::get<std::string>(value);
  for (const FolderPreference& preference : folders())
    if (name == preference.name) settings.*preference.folder = std::get<std::string>(value);
}

}  // namespace etendue::viewer
