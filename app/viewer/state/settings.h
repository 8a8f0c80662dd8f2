// The settings that the viewer keeps between sessions.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "render/denoised_image.h"
#include "viewer/platform/window_geometry.h"

namespace etendue::viewer {

inline constexpr float kMinScale = 0.75f, kMaxScale = 4;
inline constexpr float kMinFontSize = 12, kMaxFontSize = 28;
inline constexpr int kMaxThreads = 1024;

struct Settings {
  WindowGeometry window;
  float column_width = 0;         // of the right column, units of the interface; 0 is the default width
  float bottom_panel_height = 0;  // units of the interface; 0 is the default height
  // From the upper right corner of the viewport to that of the window with pixel values, to the left and down, units of
  // the interface; none: its usual place.
  std::optional<Vec2> pixel_values_offset;
  bool dark = true;
  std::vector<std::string> recent;  // newest first
  std::string folder;               // of the file that was last opened or saved

  float ui_scale = 0;                            // pixels per unit of the interface; 0: that of the display
  float font_size = 16;                          // units of the interface
  bool show_welcome = true;                      // the welcome page, when no scene is named
  bool show_details = false;                     // speed, memory and features, in the status bar
  bool automatic_integrator = true;              // chosen for each scene that is opened
  int threads = 0;                               // 0: one per hardware thread; applied at the next start
  std::string environment;                       // built-in environment for scenes without lights; empty: the first one
  std::string snapshot_folder;                   // empty: default_snapshot_folder()
  bool snapshots_have_samples = true;            // so that renderings continue from them
  render::Denoiser denoiser = render::Denoiser::automatic;  // of the denoised image
  std::string material_folder;                   // library; empty: default_material_folder()
  std::string scene_folder, environment_folder;  // where the file dialog starts; empty: `folder`
  std::map<std::string, std::string> shortcuts;  // by the name of the action; only those that were changed
};

// The settings file: viewer.json in `folder`, or in $XDG_CONFIG_HOME/etendue if `folder` is empty. Empty if the user has
// no home folder.
std::filesystem::path settings_file(const std::filesystem::path& folder);
// The folder of the journals of unsaved edits: `folder`/recovery, or $XDG_STATE_HOME/etendue/recovery.
std::filesystem::path recovery_folder(const std::filesystem::path& folder);

// Where snapshots are saved unless the settings name a folder: "etendue" in the user's pictures, or "snapshots" in
// $XDG_STATE_HOME/etendue. Empty if the user has no home folder.
std::filesystem::path default_snapshot_folder();
// The folder of the settings, or the default.
std::filesystem::path snapshot_folder(const Settings& settings);

// The library of materials unless the settings name a folder: $XDG_DATA_HOME/etendue/materials. Empty if the user has no
// home folder.
std::filesystem::path default_material_folder();

// Without a settings file, returns the defaults. A file that cannot be read is renamed to NAME.damaged; `note` then
// says so.
Settings load_settings(const std::filesystem::path& file, std::string& note);
// Returns false if the file cannot be written.
bool save_settings(const std::filesystem::path& file, const Settings& settings);

// Adds a file or a built-in scene to the list of recent files, and makes the folder of the file the current one.
void remember_recent(Settings& settings, const std::string& file);

}  // namespace etendue::viewer
