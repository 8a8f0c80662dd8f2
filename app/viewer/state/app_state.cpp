#include "viewer/state/app_state.h"

#include "render/session.h"
#include "render/session_file.h"
#include "viewer/files/file_edits.h"
#include "viewer/files/image_export.h"
#include "viewer/files/loader.h"
#include "viewer/files/scene_export.h"
#include "viewer/files/session_export.h"
#include "viewer/platform/platform.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"
#include "viewer/state/object_edits.h"
#include "viewer/tasks/exclusive_task.h"
#include "viewer/tasks/file_thumbnails.h"
#include "viewer/tasks/path_class_task.h"
#include "viewer/tasks/surface_analysis.h"
#include "viewer/viewport/aov_layer.h"
#include "viewer/viewport/comparison.h"
#include "viewer/viewport/pixel_readout.h"
#include "viewer/viewport/selection_outline.h"
#include "viewer/viewport/stored_points.h"

namespace etendue::viewer {
namespace {

constexpr double kPublishInterval = 0.1;  // seconds between frames of the session

}  // namespace

AppState::AppState(Platform& p, const ViewOptions& o)
    : platform(p),
      options(o),
      session(std::make_unique<render::Session>(render::SessionOptions{
          .threads = o.threads, .interactive = true, .publish_interval = kPublishInterval, .sharing = o.sharing})),
      editor(std::make_unique<Editor>(*session)),
      tasks{.exclusive = std::make_unique<ExclusiveTask>(*session),
            .path_classes = std::make_unique<PathClassTask>(),
            .surface_analysis = std::make_unique<SurfaceAnalysis>(),
            .thumbnails = std::make_unique<FileThumbnails>([&p] { p.wake(); })},
      task_context{.session = *session,
                   .editor = *editor,
                   .exclusive = *tasks.exclusive,
                   .notices = notices,
                   .threads = o.threads,
                   .wake = [&p] { p.wake(); }} {
  const auto& wake = task_context.wake;
  session->on_update(wake);
  files.loader = std::make_unique<Loader>(wake);
  files.image_export = std::make_unique<ImageExport>(*session, *editor, wake);
  files.scene_export = std::make_unique<SceneExport>(wake);
  files.session_export = std::make_unique<SessionExport>(wake);
  files.edits = std::make_unique<FileEdits>(wake);
  viewport.aov = std::make_unique<AovLayer>(*session, *editor, wake);
  viewport.comparison = std::make_unique<Comparison>(wake);
  viewport.pixel_readout = std::make_unique<PixelReadout>(*session, *editor, wake);
  viewport.selection_outline = std::make_unique<SelectionOutline>(*session, *editor, wake);
  viewport.stored_points = std::make_unique<StoredPoints>(*session, *editor, wake);
  ui.scale = platform.scale();
}

AppState::~AppState() = default;

bool AppState::has_document() const { return !editor->empty(); }

const render::Document& AppState::document() const { return editor->document(); }

void AppState::edit(const render::DocumentParameter& parameter, const Value& value, const std::string& gesture) {
  edit(std::span(&parameter, 1), std::span(&value, 1), gesture);
}

void AppState::edit(std::span<const render::DocumentParameter> parameters, std::span<const Value> values,
                    const std::string& gesture) {
  const render::DocumentParameter& first = parameters.front();
  const std::string& integrator = document().method.integrator;
  if (first.info.name == "render.integrator" && to_string(values.front()) != integrator)
    previous_integrator = integrator;
  render::Document changed = document();
  for (size_t i = 0; i < parameters.size(); ++i) parameters[i].assign(changed, values[i]);
  edit(std::move(changed), full_label(document(), first), gesture);
}

void AppState::edit(render::Document changed, const std::string& name, const std::string& gesture) {
  editor->apply(std::move(changed), name, gesture);
}

void AppState::edit_camera(const Camera& camera, const std::string& name, const std::string& gesture) {
  render::Document changed = document();
  changed.camera = camera;
  edit(std::move(changed), name, gesture);
}

void AppState::set_parameter(const std::string& name, const Value& value) {
  if (!has_document()) return;
  if (const auto parameter = document_parameter(document(), name)) edit(*parameter, value);
}

std::string AppState::incompatibility() const {
  const auto status = session->status();
  return has_document() && status.version == editor->version() ? status.incompatibility : "";
}

void AppState::open_file(const std::string& file) { files.loader->open(file, document(), settings.environment); }

void AppState::save_session() {
  if (files.session_file.empty()) return save_session_as();
  if (!files.session_export->is_busy()) files.session_export->write(files.session_file, document(), editor->revision());
}

void AppState::save_session_as() {
  files.request = FileRequest{.title = "Save the session (.etendue)",
                              .extensions = {render::kSessionExtension},
                              .saves = true,
                              .name = scene_stem(document()) + render::kSessionExtension,
                              .accept = [this](const std::string& file) {
                                files.session_file = file;
                                save_session();
                              }};
}

void AppState::show_parameter(const std::string& name) {
  if (!panels.reveal_parameter(*this, name)) return;
  interface.visible = true;
  interface.panel_filter.clear();
  interface.bottom_filter.clear();
  interface.detached_filters.clear();
  ui.items.point_out(name);
}

void AppState::after_unsaved_edits(std::function<void(AppState&)> proceed) {
  if (has_document() && editor->has_unsaved_scene_edits())
    files.after_unsaved_edits = std::move(proceed);
  else
    proceed(*this);
}

void AppState::store_settings() {
  if (files.settings.empty()) return;
  if (platform.has_display()) settings.window = platform.geometry();
  save_settings(files.settings, settings);
}

void AppState::select(int node, int material) {
  selection.node = node;
  selection.others.clear();
  selection.part = material;
  if (material >= 0) selection.material = material;
  // An image of an earlier document may show objects that this one does not have.
  drop_stale_selection(*this);
  if (selection.node < 0) return;
  const auto& scene = *document().scene;
  const auto& selected = scene.nodes[static_cast<size_t>(node)];
  if (selected.light >= 0) selection.light = selected.light;
  if (material >= 0 || selected.mesh < 0) return;
  const auto& primitives = scene.meshes[static_cast<size_t>(selected.mesh)].primitives;
  if (!primitives.empty()) selection.material = primitives.front().material;
  selection.part = primitives.size() == 1 ? selection.material : -1;
}

bool AppState::shows_aov() const {
  return !viewport.aov_name.empty() && viewport.aov->image().name == viewport.aov_name;
}

bool AppState::is_active_tool(std::string_view name) const {
  return viewport.click_tool && viewport.click_tool->name == name;
}

void AppState::toggle_tool(ClickTool tool) {
  viewport.focus.cancel_selection();
  if (is_active_tool(tool.name))
    viewport.click_tool.reset();
  else
    viewport.click_tool = std::move(tool);
}

}  // namespace etendue::viewer
