#include "viewer/frame_update.h"

#include <algorithm>
#include <utility>

#include "light/environments/uniform.h"
#include "render/default_light.h"
#include "render/session.h"
#include "render/shared_sampling.h"
#include "scene/builtin/builtin.h"
#include "scene/variants.h"
#include "viewer/files/file_edits.h"
#include "viewer/files/file_names.h"
#include "viewer/files/image_export.h"
#include "viewer/files/loader.h"
#include "viewer/files/scene_export.h"
#include "viewer/files/session_export.h"
#include "viewer/platform/platform.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"
#include "viewer/state/object_edits.h"
#include "viewer/tasks/file_thumbnails.h"
#include "viewer/tasks/path_class_task.h"
#include "viewer/tasks/surface_analysis.h"
#include "viewer/viewport/aov_layer.h"
#include "viewer/viewport/comparison.h"
#include "viewer/viewport/first_view.h"
#include "viewer/viewport/image_view.h"
#include "viewer/viewport/pixel_readout.h"
#include "viewer/viewport/selection_outline.h"
#include "viewer/viewport/stored_points.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

std::vector<Task*> all_tasks(const AppState& state) {
  std::vector<Task*> tasks{state.tasks.path_classes.get(), state.tasks.surface_analysis.get()};
  for (const auto& panel : state.panels.all())
    for (Task* task : panel->tasks()) tasks.push_back(task);
  return tasks;
}

// Replaces the environment. Edits that were made while the file was read stay in effect.
void use_environment(AppState& state, const OpenedFile& opened) {
  render::Document changed = state.document();
  auto scene = std::make_shared<scene::Scene>(*changed.scene);
  scene->environment = opened.document.scene->environment;
  changed.scene = std::move(scene);
  state.edit(std::move(changed), "Environment");
  state.notices.add_message("Environment map: " + base_name(opened.file));
}

// The name of the window: that of the session file if there is one, otherwise of the scene.
void set_title(AppState& state) {
  state.platform.set_title(title_of(state.document(), state.files.session_file) + " - \u00c9tendue");
}

// The environment that was added to a scene without lights is named in a message of its own.
void add_warnings_of_scene(AppState& state) {
  const render::Document& document = state.document();
  auto warnings = document.scene->warnings;
  if (std::erase(warnings, render::kNoLightWarning) > 0) {
    const std::string& name = document.scene->environment.map ? document.scene->environment.file : kUniform.name;
    const BuiltinEnvironment* environment = find_builtin_environment(name);
    const std::string label = environment ? environment->label : name;
    const bool is_empty = document.scene_name == scene::kNewScene;
    state.notices.add_message(is_empty ? "An empty scene in the environment \"" + label + "\". The Edit menu adds shapes and lights."
                                       : "No lights in the file: the environment \"" + label + "\" was added.",
                              "tab.light");
  }
  state.notices.add_warnings(base_name(document.scene_name), warnings);
}

// The names of objects may contain characters that the fonts do not have yet.
void add_glyphs(GlyphSet& glyphs, const render::Document& document) {
  const scene::Scene& scene = *document.scene;
  const auto add = [&](const auto& list) {
    for (const auto& object : list) glyphs.add(object.name);
  };
  glyphs.add(document.scene_name);
  add(scene.nodes);
  add(scene.materials);
  add(scene.lights);
  add(scene.cameras);
  for (const std::string& label : scene::variant_labels(scene)) glyphs.add(label);
}

void open_document(AppState& state, OpenedFile opened) {
  render::Document& document = opened.document;
  if (opened.kind == OpenedFile::Kind::scene) {
    fit_image(document, state.viewport.region.size);
    document.automatic.enabled = state.chooses_integrators();
  }
  state.selection = {};
  state.previous_integrator.clear();
  for (Task* task : all_tasks(state)) task->reset(state.task_context);
  state.files.edits->cancel();
  state.session->pause(false);
  state.editor->open(std::move(document), opened.kind == OpenedFile::Kind::recovered, std::move(opened.resume_point));
  state.viewport.pivot_is_outdated = true;
  state.viewport.first_view = opened.kind == OpenedFile::Kind::scene ? FirstView::camera_pending : FirstView::adjusted;
  state.viewport.playback = {};
  state.viewport.zoom = {};
  state.viewport.fit.reset(state.document(), opened.kind == OpenedFile::Kind::scene);
  state.viewport.focus.clear();
  if (opened.kind == OpenedFile::Kind::recovered) state.files.journal->adopt(opened.file);
  state.files.session_file = opened.kind == OpenedFile::Kind::session ? opened.file : "";
  set_title(state);
  add_glyphs(state.ui.glyphs, state.document());
  state.notices.close_all();
  add_warnings_of_scene(state);
}

void take_opened_file(AppState& state) {
  // The size of the viewport is known after the first frame.
  if (state.viewport.region.size.x < 1) return;
  auto opened = state.files.loader->take_result();
  if (!opened) return;
  if (!*opened) return state.notices.add_error(opened->error().message);
  OpenedFile& file = **opened;
  if (file.kind != OpenedFile::Kind::recovered) {
    remember_recent(state.settings, file.file);
    state.store_settings();
  }
  if (file.kind == OpenedFile::Kind::environment) return use_environment(state, file);
  // The function must be copyable; the samples of a snapshot are not copied.
  const auto kept = std::make_shared<OpenedFile>(std::move(file));
  state.after_unsaved_edits([kept](AppState& s) { open_document(s, std::move(*kept)); });
}

// The picture of a snapshot is shown until its rendering has an image.
void update_stored_picture(AppState& state) {
  auto& shown = state.viewport.stored_picture;
  if (state.files.loader->is_busy()) {
    shown = state.files.loader->picture();
    return;
  }
  const auto frame = state.session->frame();
  if (!state.has_document() || (frame && frame->version == state.editor->version())) shown.reset();
}

void take_saved_session(AppState& state) {
  auto saved = state.files.session_export->take_result();
  if (!saved) return;
  if (!*saved) return state.notices.add_error(saved->error().message);
  const SavedSession& session = **saved;
  state.editor->mark_saved(session.document, session.revision);
  state.notices.add_message("Saved " + session.file);
  remember_recent(state.settings, session.file);
  state.store_settings();
  set_title(state);
  const auto proceed = std::exchange(state.files.after_unsaved_edits, nullptr);
  if (proceed) proceed(state);
}

void take_saved_files(AppState& state) {
  if (const auto saved = state.files.image_export->update()) {
    if (*saved)
      state.notices.add_message("Saved " + (*saved)->file);
    else
      state.notices.add_error(saved->error().message);
    if (*saved && (*saved)->has_state) state.editor->mark_saved((*saved)->document, (*saved)->revision);
  }
  if (const auto saved = state.files.scene_export->take_result()) {
    if (!*saved) return state.notices.add_error(saved->error().message);
    state.editor->mark_scene_saved((*saved)->scene);
    state.notices.add_message("Saved " + (*saved)->file);
    state.notices.add_warnings(base_name((*saved)->file), (*saved)->warnings);
  }
}

void take_saved_material(AppState& state) {
  const auto saved = state.files.material_save.take_result();
  if (!saved) return;
  if (*saved)
    state.notices.add_message("Saved " + **saved);
  else
    state.notices.add_error(saved->error().message);
}

void make_file_edits(AppState& state) {
  while (const auto edit = state.files.edits->take_result()) {
    if (*edit)
      (**edit)(state);
    else
      state.notices.add_error(edit->error().message);
  }
}

void take_loaded_image(AppState& state) {
  const auto loaded = state.viewport.comparison->take_load_result();
  if (!loaded) return;
  if (*loaded)
    state.notices.add_message(**loaded);
  else
    state.notices.add_error(loaded->error().message);
}

// None while the frame shows an earlier document.
Darkness darkness_of_frame(const AppState& state) {
  const auto scene = state.session->scene();
  const auto& frame = state.viewport.frame;
  if (!scene || frame->version != state.editor->version()) return Darkness::none;
  return find_darkness(state.document(), *scene, *frame);
}

// Uploads the newest frame, or the AOV if one is shown.
void update_image(AppState& state, ImageView& live_image) {
  ViewportState& viewport = state.viewport;
  const bool has_new_aov = viewport.aov->update(viewport.aov_name, state.settings.denoiser);
  const bool shows_aov = state.shows_aov();
  const bool switched = shows_aov != viewport.aov_is_uploaded;
  if (shows_aov && (has_new_aov || switched)) {
    const AovImage& image = viewport.aov->image();
    live_image.upload(image.width, image.height, image.pixels);
  }
  const auto latest = state.session->frame();
  if (latest && (latest != viewport.frame || switched)) {
    // After an edit that does not change the light, frames share their pixels.
    const bool is_uploaded = viewport.frame && viewport.frame->pixels == latest->pixels && !switched;
    viewport.frame = latest;
    viewport.darkness = darkness_of_frame(state);
    if (!shows_aov && !is_uploaded) live_image.upload(latest->width, latest->height, *latest->pixels);
  }
  viewport.aov_is_uploaded = shows_aov;
}

void update_comparison_source(AppState& state) {
  const auto& frame = state.viewport.frame;
  if (!frame || frame->version != state.editor->version()) return;
  const auto& method = state.document().method;
  const std::string spec = method.integrator + ":sampler=" + method.sampler;
  const std::string unavailable = with_labels(state.document(), state.incompatibility()).text;
  const std::string samples = unavailable.empty() ? formatted(", %u spp", frame->samples) : "";
  state.viewport.comparison->live = {.name = short_method_name(spec) + samples,
                                     .label = method_label(spec) + samples,
                                     .frame = frame,
                                     .unavailable = unavailable};
}

void update_pivot(AppState& state) {
  if (!state.viewport.pivot_is_outdated || state.session->status().version < state.editor->version()) return;
  const auto scene = state.session->scene();
  if (!scene) return;
  state.viewport.camera_controller.reset_pivot(state.document().camera, *scene);
  state.viewport.pivot_is_outdated = false;
}

}  // namespace

void update_state(AppState& state, ImageView& live_image) {
  if (state.options.sharing)
    for (const std::string& message : state.options.sharing->take_messages()) state.notices.add_message(message);
  take_opened_file(state);
  update_stored_picture(state);
  take_saved_files(state);
  take_saved_session(state);
  take_saved_material(state);
  take_loaded_image(state);
  if (!state.has_document()) return;
  make_file_edits(state);
  drop_stale_selection(state);
  state.viewport.focus.update(state);
  update_image(state, live_image);
  update_comparison_source(state);
  for (const auto& panel : state.panels.all()) panel->update(state);
  state.tasks.surface_analysis->update(state.task_context, state.selection.material);
  state.viewport.pixel_readout->update(state.viewport.show_pixel_values && state.interface.visible);
  state.viewport.selection_outline->update(state.interface.visible ? selected_nodes(state) : std::vector<int>());
  state.viewport.stored_points->update(state.viewport.show_stored_points);
  const auto& display = state.document().display;
  state.viewport.comparison->update(display.exposure, display.curve);
  update_pivot(state);
  adjust_first_view(state);
  state.viewport.fit.update(state);
}

bool has_task_update(const AppState& state) {
  if (state.tasks.thumbnails->has_result()) return true;
  return std::ranges::any_of(all_tasks(state), [](const Task* task) { return task->has_update(); });
}

bool has_waiting_task(const AppState& state) {
  return std::ranges::any_of(all_tasks(state), [](const Task* task) { return task->is_waiting(); });
}

bool is_file_active(const AppState& state) {
  const FileState& files = state.files;
  const bool any_file = files.loader->is_busy() || files.image_export->is_busy() || files.scene_export->is_busy() ||
                        files.session_export->is_busy() || files.edits->is_busy() || files.material_save.running();
  return any_file || std::ranges::any_of(all_tasks(state), [](const Task* task) { return task->is_saving(); });
}

}  // namespace etendue::viewer
