#include "viewer/actions.h"

#include <ctime>
#include <sstream>

#include "integrator/integrator.h"
#include "render/aov.h"
#include "viewer/drawer.h"

namespace etendue::viewer {
namespace {

std::string snapshot_name(const Workbench& w) {
  const std::string scene = std::filesystem::path(w.editor.document().scene_name).stem().string();
  char stamp[32] = "";
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::strftime(stamp, sizeof stamp, "%Y%m%d-%H%M%S", &local);
  return (scene.empty() ? "scene" : scene) + "-" + stamp;
}

void edit_exposure(Workbench& w, double change) {
  for (const auto& binding : render::bindings(w.editor.document(), "camera"))
    if (binding.info.name == "camera.exposure") {
      const double now = std::get<double>(binding.info.default_value);
      w.edit(binding, std::clamp(now + change, binding.info.min, binding.info.max), "keys.exposure");
    }
}

void next_aov(Workbench& w) {
  const auto& names = render::aov_names();
  const auto at = std::find(names.begin(), names.end(), w.view.aov);
  // After the last comes the picture itself again.
  w.view.aov = w.view.aov.empty() ? names.front() : at == names.end() || at + 1 == names.end() ? "" : *(at + 1);
}

void file_actions(Actions& a, Workbench* w) {
  const auto loaded = [w] { return !w->editor.empty(); };
  a.add({"file.open", "File", "Open...", "A scene, a snapshot, or an environment", "ctrl+o", [w] {
           w->files.ask("Open a scene (.gltf, .glb), a snapshot or an environment (.exr, .hdr)", w->settings.folder,
                        {".gltf", ".glb", ".exr", ".hdr"}, false, "", [w](const std::string& file) { w->open(file); });
         }, {}, {}});
  a.add({"file.reload", "File", "Reload", "Reads the file again and forgets all edits", "f5", [w] { w->open(w->editor.document().scene_name); }, loaded, {}});
  a.add({"file.cornell", "File", "Open the Cornell box", "The scene that the program brings along", "", [w] { w->open("cornell"); }, {}, {}});
  a.add({"file.cancel", "", "Cancel opening", "Stops waiting for the file that is being read", "", [w] { w->loader.cancel(); }, [w] { return w->loader.busy(); }, {}});
  a.add({"environment.load", "File", "Load an environment...", "Light from all around, from an equirectangular .hdr or .exr", "", [w] {
           w->files.ask("Load an environment (.hdr, .exr)", w->settings.folder, {".hdr", ".exr"}, false, "",
                        [w](const std::string& file) { w->open(file); });
         }, loaded, {}});
  a.add({"snapshot.save", "File", "Save a snapshot", "The picture as floats with its whole state, in the folder last used; drop the file on the window to have everything back",
         "ctrl+s", [w] { w->save_snapshot((std::filesystem::path(w->settings.folder) / (snapshot_name(*w) + ".exr")).string()); }, loaded, {}});
  a.add({"snapshot.save-as", "File", "Save the picture as...", ".exr with its state, .hdr, or .png as it is shown", "ctrl+shift+s", [w] {
           w->files.ask("Save the picture (.exr, .hdr, .png)", w->settings.folder, {".exr", ".hdr", ".png"}, true, snapshot_name(*w) + ".png",
                        [w](const std::string& file) { w->save_snapshot(file); });
         }, loaded, {}});
  a.add({"app.quit", "File", "Quit", "Closes the window; settings are remembered", "ctrl+q", [w] { w->quit = true; }, {}, {}});
}

void edit_actions(Actions& a, Workbench* w) {
  a.add({"edit.undo", "Edit", "Undo", "Takes the last edit back", "ctrl+z", [w] { w->editor.undo(); }, [w] { return w->editor.undo_depth() > 0; }, {}});
  a.add({"edit.redo", "Edit", "Redo", "Makes the edit again that was taken back", "ctrl+shift+z", [w] { w->editor.redo(); }, [w] { return w->editor.redo_depth() > 0; }, {}});
  a.add({"edit.deselect", "Edit", "Select nothing", "Forgets what was picked", "escape", [w] { w->selection = {}, w->view.focus_by_click = false; },
         [w] { return w->selection.node >= 0 || w->view.focus_by_click; }, {}});
}

void render_actions(Actions& a, Workbench* w) {
  const auto loaded = [w] { return !w->editor.empty(); };
  a.add({"render.pause", "Render", "Pause", "Keeps the picture as it is, and the processor free", "space", [w] { w->session.pause(!w->session.paused()); }, loaded,
         [w] { return w->session.paused(); }});
  a.add({"render.restart", "Render", "Restart", "Throws the samples away and starts again", "r", [w] { w->session.restart(); }, loaded, {}});
  a.add({"render.previous", "Render", "Previous integrator", "Back and forth between the last two", "tab", [w] {
           const auto& infos = integrator::integrator_infos();
           for (size_t i = 0; i < infos.size(); ++i)
             if (infos[i].name == w->previous_integrator) return w->choose_integrator(i);
         }, [w] { return !w->previous_integrator.empty(); }, {}});
  const auto& infos = integrator::integrator_infos();
  for (size_t i = 0; i < infos.size(); ++i) {
    const std::string key = i < 9 ? std::to_string(i + 1) : i == 9 ? "0" : "";
    a.add({"integrator." + infos[i].name, "Render", infos[i].label, infos[i].doc, key, [w, i] { w->choose_integrator(i); }, loaded,
           [w, name = infos[i].name] { return w->editor.document().method.integrator == name; }});
  }
}

void view_actions(Actions& a, Workbench* w) {
  const auto loaded = [w] { return !w->editor.empty(); };
  a.add({"view.frame-all", "View", "Frame all", "Moves the camera until everything is seen", "home", [w] { w->frame_scene(); }, loaded, {}});
  a.add({"view.frame-selection", "View", "Frame selection", "Moves the camera until what is selected fills the picture", "f", [w] { w->frame_selection(); }, loaded, {}});
  a.add({"view.fit", "View", "Fit the picture to the viewport", "Gives the picture as many pixels as the viewport has; restarts it", "", [w] {
           render::Document changed = w->editor.document();
           changed.width = std::max(16, static_cast<int>(w->view.region.size.x));
           changed.height = std::max(16, static_cast<int>(w->view.region.size.y));
           w->edit(std::move(changed), "Picture size");
         }, loaded, {}});
  a.add({"display.darker", "View", "Exposure down", "By half a stop", "[", [w] { edit_exposure(*w, -0.5); }, loaded, {}});
  a.add({"display.brighter", "View", "Exposure up", "By half a stop", "]", [w] { edit_exposure(*w, 0.5); }, loaded, {}});
  a.add({"display.next-aov", "View", "Next layer", "Albedo, normals, depth, ids, and the picture again", "v", [w] { next_aov(*w); }, loaded, {}});
  a.add({"display.toggle-false-color", "View", "False colour", "Luminance on a logarithmic scale", "l", [w] { w->view.false_color = !w->view.false_color; }, {},
         [w] { return w->view.false_color; }});
  a.add({"view.health-map", "View", "Map of tails", "Marks the parts of the picture whose rarest samples are too bright for its error to be trusted", "", [w] { w->view.health_map = !w->view.health_map; }, loaded,
         [w] { return w->view.health_map; }});
  a.add({"view.interface", "View", "Interface", "Hides everything but the picture", "h", [w] { w->view.interface = !w->view.interface; }, {},
         [w] { return w->view.interface; }});
  for (const SheetInfo& sheet : sheets())
    a.add({std::string("view.") + sheet.name, "View", sheet.label, sheet.doc, "", [w, name = sheet.name] { w->view.sheet = w->view.sheet == name ? "" : name; }, loaded,
           [w, name = sheet.name] { return w->view.sheet == name; }});
  a.add({"view.dark", "View", "Dark theme", "Dark or light", "", [w] {
           w->settings.dark = !w->settings.dark;
           w->theme = apply_theme(w->settings.dark, w->platform.scale());
         }, {}, [w] { return w->settings.dark; }});
  a.add({"app.palette", "Help", "Find an action...", "Every action by its name", "ctrl+k", [w] { w->view.palette = true; }, {}, {}});
  a.add({"app.help", "Help", "Keys and hands", "What every key and button does", "f1 ?", [w] { w->view.help = !w->view.help; }, {}, [w] { return w->view.help; }});
}

}  // namespace

std::vector<Chord> Action::chords() const {
  std::vector<Chord> list;
  std::istringstream words(shortcut);
  for (std::string word; words >> word;)
    if (const auto chord = parse_chord(word)) list.push_back(*chord);
  return list;
}

const Action* Actions::find(std::string_view name) const {
  for (const auto& action : list_)
    if (action.name == name) return &action;
  return nullptr;
}

void Actions::run_pressed(const Input& input) const {
  if (input.keys_pressed.none()) return;
  for (const auto& action : list_)
    for (const Chord& chord : action.chords())
      if (chord.pressed(input) && action.is_enabled()) action.run();
}

void add_actions(Actions& actions, Workbench* workbench) {
  file_actions(actions, workbench);
  edit_actions(actions, workbench);
  render_actions(actions, workbench);
  view_actions(actions, workbench);
}

}  // namespace etendue::viewer
