// Opening and saving files.
#include <ctime>

#include "image/format.h"
#include "light/environments/builtin_environment.h"
#include "render/document.h"
#include "scene/builtin/builtin.h"
#include "viewer/actions/all_actions.h"
#include "viewer/actions/conditions.h"
#include "viewer/files/file_names.h"
#include "viewer/files/image_export.h"
#include "viewer/files/loader.h"
#include "viewer/files/scene_export.h"
#include "viewer/state/document_info.h"

namespace etendue::viewer {
namespace {

// Sections of the menu.
constexpr const char* kOpenSection = "open";
constexpr const char* kSaveSection = "save";
constexpr const char* kExportSection = "export";
constexpr const char* kQuitSection = "quit";

// "SCENE-20240131-235959".
std::string snapshot_name(const AppState& state) {
  char stamp[32] = "";
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::strftime(stamp, sizeof stamp, "%Y%m%d-%H%M%S", &local);
  return scene_stem(state.document()) + "-" + stamp;
}

void request_image_export(AppState& state) {
  state.files.request =
      image_file_request("Export image", snapshot_name(state) + ".png",
                         [&state](const std::string& file) { state.files.image_export->request(file); });
}

// Asks for a file name only if there is no folder for snapshots.
void save_snapshot(AppState& state) {
  const std::filesystem::path folder = snapshot_folder(state.settings);
  if (folder.empty()) return request_image_export(state);
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) return state.notices.add_error(folder.string() + ": cannot be created: " + code.message());
  state.files.image_export->request(unused_file(folder, snapshot_name(state), ".exr").string(),
                                    state.settings.snapshots_have_samples ? SavedSamples::checkpoint
                                                                          : SavedSamples::none);
}

void request_open(AppState& state, std::string title, std::vector<std::string> extensions, std::string folder) {
  state.files.request = FileRequest{.title = std::move(title),
                                    .extensions = std::move(extensions),
                                    .folder = std::move(folder),
                                    .accept = [&state](const std::string& file) { state.open_file(file); }};
}

void request_scene_export(AppState& state) {
  state.files.request = FileRequest{
      .title = "Export scene (.glb, .gltf)",
      .extensions = {".glb", ".gltf"},
      .saves = true,
      .name = scene_stem(state.document()) + "-saved.glb",
      .accept = [&state](const std::string& file) { state.files.scene_export->write(file, state.document()); }};
}

void add_open_actions(ActionList& actions) {
  actions.add({.name = "file.new",
               .menu = "File",
               .label = "New scene",
               .tooltip = "Opens an empty scene in studio light. The Edit menu adds shapes, lights and cameras",
               .shortcut = "ctrl+n",
               .run = [](AppState& state) { state.open_file(scene::kNewScene); },
               .section = kOpenSection});
  actions.add({.name = "file.open",
               .menu = "File",
               .label = "Open...",
               .tooltip = "Opens a scene, a session, a snapshot or an environment map",
               .shortcut = "ctrl+o",
               .run =
                   [](AppState& state) {
                     std::vector<std::string> extensions{".gltf", ".glb", ".etendue"};
                     for (std::string& extension : image::readable_extensions())
                       extensions.push_back(std::move(extension));
                     request_open(state,
                                  "Open a scene (.gltf, .glb), a session (.etendue), a snapshot (.exr), or an image as "
                                  "environment map",
                                  std::move(extensions), state.settings.scene_folder);
                   },
               .section = kOpenSection});
  actions.add({.name = "file.reload",
               .menu = "File",
               .label = "Reload",
               .tooltip = "Reads the scene file again and discards all edits",
               .shortcut = "f5",
               .run = [](AppState& state) { state.open_file(state.document().scene_name); },
               .enabled = has_document,
               .section = kOpenSection});
  for (const scene::Builtin& builtin : scene::builtins())
    actions.add({.name = std::string("file.") + builtin.name,
                 .menu = "File",
                 .label = builtin.label,
                 .tooltip = builtin.doc,
                 .run = [name = builtin.name](AppState& state) { state.open_file(name); },
                 .section = kOpenSection,
                 .submenu = "Built-in scenes"});
  actions.add({.name = "file.cancel",
               .label = "Cancel opening",
               .tooltip = "Cancels the file that is being read",
               .run = [](AppState& state) { state.files.loader->cancel(); },
               .enabled = [](const AppState& state) { return state.files.loader->is_busy(); }});
  actions.add({.name = "environment.load",
               .menu = "File",
               .label = "Load environment map...",
               .tooltip = "Lights the scene with an equirectangular environment map (.hdr, .exr, ...)",
               .run =
                   [](AppState& state) {
                     request_open(state, "Load an environment map (.hdr, .exr or another image format)",
                                  image::readable_extensions(), state.settings.environment_folder);
                   },
               .enabled = has_document,
               .section = kOpenSection,
               .submenu = "Environment"});
  for (const BuiltinEnvironment& builtin : builtin_environments()) {
    const bool is_studio = std::string_view(builtin.name) == "studio";
    actions.add({.name = std::string("environment.") + builtin.name,
                 .menu = "File",
                 .label = is_studio ? "Add studio light" : std::string("Use environment: ") + builtin.label,
                 .tooltip = builtin.doc,
                 .run = [name = std::string(builtin.name)](
                            AppState& state) { state.set_parameter("environment.preset", name); },
                 .enabled = has_document,
                 .section = kOpenSection,
                 .submenu = "Environment"});
  }
}

}  // namespace

void add_file_actions(ActionList& actions) {
  add_open_actions(actions);
  actions.add({.name = "session.save",
               .menu = "File",
               .label = "Save",
               .tooltip = "Saves the session: the scene's file name and all parameters, without an image",
               .shortcut = "ctrl+s",
               .run = [](AppState& state) { state.save_session(); },
               .enabled = has_document,
               .section = kSaveSection});
  actions.add({.name = "session.save-as",
               .menu = "File",
               .label = "Save as...",
               .tooltip = "Saves the session under another name (.etendue)",
               .shortcut = "ctrl+shift+s",
               .run = [](AppState& state) { state.save_session_as(); },
               .enabled = has_document,
               .section = kSaveSection});
  actions.add({.name = "snapshot.save",
               .menu = "File",
               .label = "Save snapshot",
               .tooltip = "Saves the image and all parameters as .exr in the folder of snapshots (Preferences), with "
                          "the samples from which the rendering continues. The Snapshots panel shows the folder",
               .shortcut = "f12",
               .run = save_snapshot,
               .enabled = has_document,
               .section = kSaveSection});
  actions.add({.name = "snapshot.save-as",
               .menu = "File",
               .label = "Export image...",
               .tooltip = "Saves the image: .exr with all parameters, .hdr with radiance, .png and others as displayed",
               .shortcut = "ctrl+e",
               .run = request_image_export,
               .enabled = has_document,
               .section = kExportSection});
  actions.add(
      {.name = "scene.save",
       .menu = "File",
       .label = "Export scene...",
       .tooltip = "Saves the edited scene, the camera and the environment as .glb, or as .gltf with separate files",
       .shortcut = "ctrl+shift+e",
       .run = request_scene_export,
       .enabled = [](const AppState& state) { return state.has_document() && !state.files.scene_export->is_busy(); },
       .section = kExportSection});
  actions.add({.name = "app.preferences",
               .menu = "File",
               .label = "Preferences...",
               .tooltip = "Scale and theme of the interface, threads, folders and keyboard shortcuts",
               .shortcut = "ctrl+,",
               .run = [](AppState& state) { state.interface.preferences_open = true; },
               .section = kQuitSection});
  actions.add({.name = "app.quit",
               .menu = "File",
               .label = "Quit",
               .tooltip = "Closes the window; asks first if there are unsaved edits",
               .shortcut = "ctrl+q",
               .run = [](AppState& state) { state.after_unsaved_edits([](AppState& s) { s.quit = true; }); },
               .section = kQuitSection});
}

}  // namespace etendue::viewer
