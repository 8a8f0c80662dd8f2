#include "viewer/actions/action.h"

#include <ctime>
#include <sstream>

#include "integrator/integrator.h"
#include "render/aov.h"
#include "scene/builtin/builtin.h"
#include "viewer/layout/bottom_panel.h"

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
  const auto names = layer_names();
  const auto at = std::find(names.begin(), names.end(), w.view.aov);
  // After the last comes the picture itself again.
  w.view.aov = w.view.aov.empty() ? names.front() : at == names.end() || at + 1 == names.end() ? "" : *(at + 1);
}

void ask_for_scene(Workbench& w) {
  const std::string scene = std::filesystem::path(w.editor.document().scene_name).stem().string();
  w.files.ask("Save the scene (.glb, .gltf)", w.settings.folder, {".glb", ".gltf"}, true,
              (scene.empty() ? "scene" : scene) + "-saved.glb",
              [&w](const std::string& file) { w.scene_writer.write(file, w.editor.document()); });
}

void file_actions(Actions& a, Workbench* w) {
  const auto loaded = [w] { return !w->editor.empty(); };
  a.add({"file.open",
         "File",
         "Open...",
         "A scene, a snapshot, or an environment",
         "ctrl+o",
         [w] {
           w->files.ask("Open a scene (.gltf, .glb), a snapshot or an environment (.exr, .hdr)", w->settings.folder,
                        {".gltf", ".glb", ".exr", ".hdr"}, false, "", [w](const std::string& file) { w->open(file); });
         },
         {},
         {}});
  a.add({"file.reload",
         "File",
         "Reload",
         "Reads the file again and forgets all edits",
         "f5",
         [w] { w->open(w->editor.document().scene_name); },
         loaded,
         {}});
  for (const scene::Builtin& builtin : scene::builtins())
    a.add({std::string("file.") + builtin.name,
           "File",
           std::string("Open: ") + builtin.label,
           builtin.doc,
           "",
           [w, name = builtin.name] { w->open(name); },
           {},
           {}});
  a.add({"file.cancel",
         "",
         "Cancel opening",
         "Stops waiting for the file that is being read",
         "",
         [w] { w->loader.cancel(); },
         [w] { return w->loader.busy(); },
         {}});
  a.add({"environment.load",
         "File",
         "Load an environment...",
         "Light from all around, from an equirectangular .hdr or .exr",
         "",
         [w] {
           w->files.ask("Load an environment (.hdr, .exr)", w->settings.folder, {".hdr", ".exr"}, false, "",
                        [w](const std::string& file) { w->open(file); });
         },
         loaded,
         {}});
  a.add({"snapshot.save",
         "File",
         "Save a snapshot",
         "The picture as floats with its whole state, in the folder last used; drop the file on the window to have "
         "everything back",
         "ctrl+s",
         [w] { w->save_snapshot((std::filesystem::path(w->settings.folder) / (snapshot_name(*w) + ".exr")).string()); },
         loaded,
         {}});
  a.add({"snapshot.save-as",
         "File",
         "Save the picture as...",
         ".exr with its state, .hdr, or .png as it is shown",
         "ctrl+shift+s",
         [w] {
           w->files.ask("Save the picture (.exr, .hdr, .png)", w->settings.folder, {".exr", ".hdr", ".png"}, true,
                        snapshot_name(*w) + ".png", [w](const std::string& file) { w->save_snapshot(file); });
         },
         loaded,
         {}});
  a.add({"scene.save",
         "File",
         "Save the scene...",
         "As .glb, or as .gltf with its pictures beside it: all edits, the camera and the light from all around",
         "ctrl+shift+e",
         [w] { ask_for_scene(*w); },
         [w] { return !w->editor.empty() && !w->scene_writer.busy(); },
         {}});
  a.add({"app.quit",
         "File",
         "Quit",
         "Closes the window; settings are remembered",
         "ctrl+q",
         [w] { w->quit = true; },
         {},
         {}});
}

void edit_actions(Actions& a, Workbench* w) {
  a.add({"edit.undo",
         "Edit",
         "Undo",
         "Takes the last edit back",
         "ctrl+z",
         [w] { w->editor.undo(); },
         [w] { return w->editor.undo_depth() > 0; },
         {}});
  a.add({"edit.redo",
         "Edit",
         "Redo",
         "Makes the edit again that was taken back",
         "ctrl+shift+z",
         [w] { w->editor.redo(); },
         [w] { return w->editor.redo_depth() > 0; },
         {}});
  a.add({"edit.deselect",
         "Edit",
         "Select nothing",
         "Forgets what was picked",
         "escape",
         [w] { w->selection = {}, w->view.focus_by_click = w->view.sampling.picks = false; },
         [w] { return w->selection.node >= 0 || w->view.focus_by_click || w->view.sampling.picks; },
         {}});
}

void render_actions(Actions& a, Workbench* w) {
  const auto loaded = [w] { return !w->editor.empty(); };
  a.add({"render.pause", "Render", "Pause", "Keeps the picture as it is, and the processor free", "space",
         [w] { w->session.pause(!w->session.paused()); },
         [w] { return !w->editor.empty() && !w->contest.running() && !w->advice.running(); },
         [w] { return w->session.paused(); }});
  a.add({"render.restart",
         "Render",
         "Restart",
         "Throws the samples away and starts again",
         "r",
         [w] { w->session.restart(); },
         loaded,
         {}});
  a.add({"render.previous",
         "Integrator",
         "Previous integrator",
         "Back and forth between the last two",
         "tab",
         [w] { w->choose_integrator(w->previous_integrator); },
         [w] { return !w->previous_integrator.empty(); },
         {}});
}

// Group by group; what the registry gives a key has it here.
void integrator_actions(Actions& a, Workbench* w) {
  const auto loaded = [w] { return !w->editor.empty(); };
  for (const auto& group : integrator::kGroups)
    for (const auto& info : integrator::integrator_infos()) {
      if (integrator::info_of(info.group).name != group.name) continue;
      const std::string key = info.shortcut ? std::string(1, info.shortcut) : "";
      a.add({"integrator." + info.name, "Integrator", info.label, info.summary, key,
             [w, name = info.name] { w->choose_integrator(name); }, loaded,
             [w, name = info.name] { return w->editor.document().method.integrator == name; }, group.label, group.doc});
    }
}

void ask_for_side(Workbench& w, Comparison::Target target) {
  const bool is_b = target == Comparison::Target::b;
  w.files.ask(std::string("Load a picture as ") + (is_b ? "B" : "the reference") + " (.exr, .hdr, .png)",
              w.settings.folder, {".exr", ".hdr", ".png"}, false, "",
              [&w, target](const std::string& file) { w.comparison.load(file, target); });
}

// Without a B, the picture as it is now becomes one: what is changed from then on is A.
void compare(Workbench& w, CompareMode mode) {
  Comparison& c = w.comparison;
  c.mode = c.mode == mode ? CompareMode::off : mode;
  if (c.mode == CompareMode::off || c.b.frame) return;
  c.pin();
  w.notices.say("Kept as B: " + c.b.name + ". What is changed from now on shows in A.");
}

void ask_for_chart(Workbench& w) {
  const std::string scene = std::filesystem::path(w.editor.document().scene_name).stem().string();
  w.files.ask("Export the chart (.svg, .png) or its points (.csv)", w.settings.folder, {".svg", ".png", ".csv"}, true,
              scene + "-convergence.svg", [&w](const std::string& file) { w.contest.write(file); });
}

void choose_all_techniques(Workbench& w) {
  const auto& info = *integrator::find_integrator(w.editor.document().method.integrator);
  for (const auto& binding : render::bindings(w.editor.document(), info.name))
    if (binding.info.name == info.name + "." + std::string(info.techniques.without)) w.edit(binding, std::string());
}

void ask_for_techniques(Workbench& w) {
  const std::string scene = std::filesystem::path(w.editor.document().scene_name).stem().string();
  w.files.ask("Export the techniques (.exr as layers, .png as a grid)", w.settings.folder, {".exr", ".png"}, true,
              scene + "-techniques.exr", [&w](const std::string& file) { w.techniques.write(file); });
}

void technique_actions(Actions& a, Workbench* w) {
  a.add({"techniques.export",
         "Render",
         "Export the techniques...",
         ".exr with a layer for each, .png as they are shown",
         "",
         [w] { ask_for_techniques(*w); },
         [w] { return w->techniques.possible() && w->techniques.shown(); },
         {}});
  a.add({"meter.pick", "View", "Light meter",
         "The next click in the picture measures there: radiance, irradiance, luminance, illuminance, flux", "m",
         [w] { w->meter.picks = !w->meter.picks; }, [w] { return !w->editor.empty(); },
         [w] { return w->meter.picks; }});
  a.add({"surface.keep",
         "Compare",
         "Keep this surface",
         "Keeps the chosen material as it is now, for what is chosen later to be seen beside it",
         "",
         [w] { w->surface.keep(), w->view.sheet = "sheet.surface"; },
         [w] { return w->surface.can_keep(); },
         {}});
  a.add({"surface.drop",
         "Compare",
         "Drop the kept surface",
         "Shows the chosen material alone again",
         "",
         [w] { w->surface.drop(); },
         [w] { return w->surface.keeps(); },
         {}});
  a.add({"techniques.all",
         "Render",
         "All techniques",
         "Leaves none out",
         "",
         [w] { choose_all_techniques(*w); },
         [w] { return w->techniques.possible() && !w->techniques.left_out().empty(); },
         {}});
}

void contest_actions(Actions& a, Workbench* w) {
  const auto loaded = [w] { return !w->editor.empty(); };
  a.add({"compare.start",
         "Compare",
         "Compare",
         "Methods take turns on this scene from this camera; their errors grow as curves",
         "",
         [w] {
           w->view.sheet = "sheet.convergence";
           w->contest.propose();
           w->advice.stop();
           if (const auto started = w->contest.start(); !started) w->notices.complain(started.error().message);
         },
         loaded,
         {}});
  a.add({"compare.stop",
         "Compare",
         "Stop",
         "Ends the turns; the curves stay",
         "",
         [w] { w->contest.stop(); },
         [w] { return w->contest.running(); },
         {}});
  a.add({"compare.go-on",
         "Compare",
         "Go on",
         "After a stop from there; after the end to twice the budget",
         "",
         [w] { w->advice.stop(), w->contest.go_on(); },
         [w] { return w->contest.can_go_on(); },
         {}});
  a.add({"compare.add-current",
         "Compare",
         "Add current",
         "Puts the method of the Render panel on the list",
         "",
         [w] { w->contest.add(name_of(w->editor.document().method)); },
         loaded,
         {}});
  a.add({"compare.export",
         "Compare",
         "Export the chart...",
         ".svg or .png as a figure, .csv as numbers",
         "",
         [w] { ask_for_chart(*w); },
         [w] { return w->contest.shown() != nullptr; },
         {}});
}

void advice_actions(Actions& a, Workbench* w) {
  a.add({"paths.measure",
         "Render",
         "Measure path classes",
         "Measures anew which light paths the energy of this view comes by",
         "",
         [w] { w->view.sheet = "sheet.paths", w->paths.measure(); },
         [w] { return !w->editor.empty() && !w->advice.running(); },
         {}});
  a.add({"paths.all",
         "Render",
         "All paths",
         "Lets all light paths count again",
         "",
         [w] { w->choose_paths(""); },
         [w] { return !w->editor.empty() && !w->editor.document().method.paths.empty(); },
         {}});
  a.add({"advice.ask",
         "Render",
         "Ask for a method",
         "Tries every method out and ranks them by the time to the error",
         "",
         [w] {
           w->contest.stop();
           w->advice.ask();
         },
         [w] { return !w->editor.empty() && !w->advice.running(); },
         {}});
  a.add({"advice.stop",
         "Render",
         "Stop asking",
         "Ends the trials; the ranking stays as far as it came",
         "",
         [w] { w->advice.stop(); },
         [w] { return w->advice.running(); },
         {}});
}

void compare_actions(Actions& a, Workbench* w) {
  const auto loaded = [w] { return w->comparison.live.frame != nullptr; };
  const auto splits = [w] { return w->comparison.mode == CompareMode::wipe && w->comparison.active(); };
  const auto add_mode = [&](const char* name, const char* label, const char* doc, const char* key, CompareMode mode) {
    a.add({name, "Compare", label, doc, key, [w, mode] { compare(*w, mode); }, loaded,
           [w, mode] { return w->comparison.mode == mode; }});
  };
  add_mode("compare.split", "Split: A | B",
           "A left and B right of a divider; without a B, the present picture is kept as B", "c", CompareMode::wipe);
  add_mode("compare.difference", "Difference: A - B",
           "The signed difference of luminance: red where A is brighter, blue where B is", "", CompareMode::difference);
  add_mode("compare.flip", "FLIP of A and B", "How different the two look on this screen, from 0 to 1", "",
           CompareMode::flip);
  a.add({"compare.swap", "Compare", "Swap A and B", "Changes the sides", "x",
         [w] { w->comparison.swapped = !w->comparison.swapped; }, [w] { return w->comparison.active(); },
         [w] { return w->comparison.swapped; }});
  a.add({"compare.pin",
         "Compare",
         "Keep this picture as B",
         "Freezes the picture as it is now; what is changed from then on is A",
         "",
         [w] {
           w->comparison.pin();
           if (w->comparison.mode == CompareMode::off) w->comparison.mode = CompareMode::wipe;
           w->notices.say("Kept as B: " + w->comparison.b.name);
         },
         loaded,
         {}});
  a.add({"compare.load-b",
         "Compare",
         "Load a picture as B...",
         "An .exr, .hdr or .png of the size of the picture",
         "",
         [w] { ask_for_side(*w, Comparison::Target::b); },
         loaded,
         {}});
  a.add({"compare.load-reference",
         "Compare",
         "Load a reference...",
         "The picture that shows while Shift is held",
         "",
         [w] { ask_for_side(*w, Comparison::Target::reference); },
         loaded,
         {}});
  a.add({"compare.reference", "Compare", "Show the reference", "Hold Shift for the same", "",
         [w] { w->comparison.shows_reference = !w->comparison.shows_reference; },
         [w] { return w->comparison.reference.frame != nullptr; }, [w] { return w->comparison.shows_reference; }});
  a.add({"compare.divider-left",
         "Compare",
         "Divider to the left",
         "By a hundredth of the picture",
         "alt+left",
         [w] { w->comparison.move_divider(-0.01f); },
         splits,
         {}});
  a.add({"compare.divider-right",
         "Compare",
         "Divider to the right",
         "By a hundredth of the picture",
         "alt+right",
         [w] { w->comparison.move_divider(0.01f); },
         splits,
         {}});
}

void view_actions(Actions& a, Workbench* w) {
  const auto loaded = [w] { return !w->editor.empty(); };
  a.add({"view.frame-all",
         "View",
         "Frame all",
         "Moves the camera until everything is seen",
         "home",
         [w] { w->frame_scene(); },
         loaded,
         {}});
  a.add({"view.frame-selection",
         "View",
         "Frame selection",
         "Moves the camera until what is selected fills the picture",
         "f",
         [w] { w->frame_selection(); },
         loaded,
         {}});
  a.add({"view.fit",
         "View",
         "Fit the picture to the viewport",
         "Gives the picture as many pixels as the viewport has; restarts it",
         "",
         [w] {
           render::Document changed = w->editor.document();
           changed.width = std::max(16, static_cast<int>(w->view.region.size.x));
           changed.height = std::max(16, static_cast<int>(w->view.region.size.y));
           w->edit(std::move(changed), "Picture size");
         },
         loaded,
         {}});
  a.add(
      {"display.darker", "View", "Exposure down", "By half a stop", "[", [w] { edit_exposure(*w, -0.5); }, loaded, {}});
  a.add(
      {"display.brighter", "View", "Exposure up", "By half a stop", "]", [w] { edit_exposure(*w, 0.5); }, loaded, {}});
  a.add({"display.next-aov",
         "View",
         "Next layer",
         "Albedo, normals, depth, ids, the error of each pixel, and the picture again",
         "v",
         [w] { next_aov(*w); },
         loaded,
         {}});
  a.add({"display.toggle-false-color",
         "View",
         "False colour",
         "Luminance on a logarithmic scale",
         "l",
         [w] { w->view.false_color = !w->view.false_color; },
         {},
         [w] { return w->view.false_color; }});
  a.add({"view.health-map", "View", "Map of tails",
         "Marks the parts of the picture whose rarest samples are too bright for its error to be trusted", "",
         [w] { w->view.health_map = !w->view.health_map; }, loaded, [w] { return w->view.health_map; }});
  a.add({"view.points", "View", "Photons, virtual lights",
         "Shows what the method keeps in space where the camera sees it, in the colour of its power", "",
         [w] { w->view.points = !w->view.points; }, loaded, [w] { return w->view.points; }});
  a.add({"view.interface",
         "View",
         "Interface",
         "Hides everything but the picture",
         "h",
         [w] { w->view.interface = !w->view.interface; },
         {},
         [w] { return w->view.interface; }});
  for (const SheetInfo& sheet : sheets())
    a.add({std::string("view.") + sheet.name, "View", sheet.label, sheet.doc, "",
           [w, name = sheet.name] { w->view.sheet = w->view.sheet == name ? "" : name; }, loaded,
           [w, name = sheet.name] { return w->view.sheet == name; }});
  a.add({"sampling.pick", "View", "Pick a pixel",
         "The next click in the picture chooses the pixel whose samples are looked at", "",
         [w] {
           w->view.sampling.picks = !w->view.sampling.picks;
           w->view.sheet = "sheet.sampling";
         },
         loaded, [w] { return w->view.sampling.picks; }});
  a.add({"view.dark",
         "View",
         "Dark theme",
         "Dark or light",
         "",
         [w] {
           w->settings.dark = !w->settings.dark;
           w->theme = apply_theme(w->settings.dark, w->platform.scale());
         },
         {},
         [w] { return w->settings.dark; }});
  a.add({"app.palette",
         "Help",
         "Find an action...",
         "Every action by its name",
         "ctrl+k",
         [w] { w->view.palette = true; },
         {},
         {}});
  a.add({"app.help",
         "Help",
         "Keys and hands",
         "What every key and button does",
         "f1 ?",
         [w] { w->view.help = !w->view.help; },
         {},
         [w] { return w->view.help; }});
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
  integrator_actions(actions, workbench);
  view_actions(actions, workbench);
  contest_actions(actions, workbench);
  technique_actions(actions, workbench);
  advice_actions(actions, workbench);
  compare_actions(actions, workbench);
}

}  // namespace etendue::viewer
