// The state of the viewer: the document and its rendering, what is selected and shown, settings, and files in progress.
//
// Panels, actions, the layout and scripts use this; it depends on none of them. State that only one panel uses belongs
// to that panel.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/parameter.h"
#include "viewer/actions/action.h"
#include "viewer/files/edit_journal.h"
#include "viewer/files/file_request.h"
#include "viewer/panels/panel_set.h"
#include "viewer/state/material_edits.h"
#include "viewer/state/node_places.h"
#include "viewer/state/notices.h"
#include "viewer/state/settings.h"
#include "viewer/tasks/background_task.h"
#include "viewer/tasks/task.h"
#include "viewer/tools/camera_controller.h"
#include "viewer/tools/gizmo.h"
#include "viewer/viewer.h"
#include "viewer/viewport/dark_image.h"
#include "viewer/viewport/first_view.h"
#include "viewer/viewport/focus_region.h"
#include "viewer/viewport/image_fit.h"
#include "viewer/viewport/image_zoom.h"
#include "viewer/viewport/placement.h"
#include "viewer/viewport/timeline.h"
#include "viewer/widgets/ui_context.h"

namespace etendue::render {
struct Document;
struct DocumentParameter;
struct Frame;
class Session;
}  // namespace etendue::render

namespace etendue::viewer {

class AovLayer;
class Comparison;
class Editor;
class ExclusiveTask;
class FileEdits;
class FileThumbnails;
class ImageExport;
class Loader;
class PathClassTask;
class PixelReadout;
class Platform;
class SceneExport;
class SessionExport;
struct StoredPicture;
class SelectionOutline;
class StoredPoints;
class SurfaceAnalysis;

// Indices into the scene; -1 if nothing is selected.
struct Selection {
  int node = -1;
  int material = -1;
  int light = -1;
  std::vector<int> others{};  // nodes that are selected besides `node`, in the order of their selection
  int part = -1;  // the material of the part of the node that was selected
};

// A tool that uses the next click in the image.
struct ClickTool {
  std::string name;  // of the action that activates it
  // `position` is in window pixels. Returns false if the click was not suitable; the tool then stays active.
  std::function<bool(AppState&, Vec2 position)> use;
};

// The image on screen and what is drawn over it. None of this changes the document.
struct ViewportState {
  Placement region;  // of the window that is left for the image
  ImageZoom zoom;
  ImageFit fit;
  Placement image;                             // that the whole image fills; beyond the region if it is enlarged
  std::shared_ptr<const render::Frame> frame;  // on screen; null before the first one
  Darkness darkness = Darkness::none;          // of the frame
  std::shared_ptr<const StoredPicture> stored_picture;  // of the file that is being opened; null: none

  bool false_color = false;
  bool show_reliability = false;
  bool show_stored_points = false;
  bool show_safe_frames = false;
  std::string aov_name;  // the AOV that is shown instead of the image; empty for the image
  std::unique_ptr<AovLayer> aov;
  std::unique_ptr<Comparison> comparison;
  bool show_pixel_values = false;
  std::optional<Vec2i> pinned_pixel;
  std::unique_ptr<PixelReadout> pixel_readout;
  std::unique_ptr<StoredPoints> stored_points;
  std::unique_ptr<SelectionOutline> selection_outline;

  // The part of the image that is inside the region.
  Placement visible_image() const { return intersection(image, region); }

  bool aov_is_uploaded = false;  // the texture of the live image has an AOV

  CameraController camera_controller;
  bool pivot_is_outdated = false;  // it belongs to the previous document
  FirstView first_view = FirstView::adjusted;
  std::string environment;  // the document's, as `first_view` knows it
  Playback playback;
  float height_of_notices = 0;  // of the messages over the lower edge of the image, pixels
  std::optional<ClickTool> click_tool;
  FocusRegion focus;
  Gizmo gizmo;
  NodePlaces node_places;
  bool show_icons = true;  // of lights and cameras
};

struct InterfaceState {
  bool visible = true;
  bool help_open = false;
  bool palette_open = false;
  bool preferences_open = false;
  bool keyboard_is_requested = false;  // the preferences change to the list of shortcuts
  bool welcome_open = false;
  bool style_is_outdated = false;     // scale, font size or theme have changed
  std::string panel_filter;           // of the right column; empty: all parameters are shown
  std::string bottom_filter;          // of the bottom panel
  std::optional<Vec2> menu_position;  // where the context menu of the viewport is to be opened
  Vec2 menu_target{0};                // the position that this menu refers to
  bool popup_open = false;            // something that Escape closes covers the interface
  bool dialog_open = false;           // notices wait until it is closed
  bool typing = false;                // a text field has the keyboard focus

  // The filters of detached panels of the right column, by the names of the panels.
  std::map<std::string, std::string> detached_filters;
};

// Files that are being read or written, and the request for a file name while the file dialog is open.
struct FileState {
  std::unique_ptr<Loader> loader;
  std::unique_ptr<ImageExport> image_export;
  std::unique_ptr<SceneExport> scene_export;
  std::unique_ptr<SessionExport> session_export;
  std::unique_ptr<FileEdits> edits;
  BackgroundTask<Result<std::string>> material_save;  // of a material to the library; returns the file
  std::optional<FileRequest> request;

  std::string session_file;  // that Save writes; empty before it has a name
  // What continues after the user has decided about unsaved edits; null if there is no question.
  std::function<void(AppState&)> after_unsaved_edits;
  std::filesystem::path settings;          // the settings file; empty if settings are not kept
  std::unique_ptr<EditJournal> journal;    // null if unsaved edits are not kept
  std::vector<LostSession> lost_sessions;  // offered for recovery
};

// Background tasks that several panels use.
struct SharedTasks {
  std::unique_ptr<ExclusiveTask> exclusive;
  std::unique_ptr<PathClassTask> path_classes;
  std::unique_ptr<SurfaceAnalysis> surface_analysis;
  std::unique_ptr<FileThumbnails> thumbnails;
};

struct Timing {
  double interface_share = 0;      // share of the time that drawing the interface takes
  // From the start of the process to the first picture of a file that is still being opened; 0 before that.
  double loading_picture_seconds = 0;
  double first_image_seconds = 0;  // from the start of the process to the first image on screen; 0 before that
};

struct AppState {
  AppState(Platform& platform, const ViewOptions& options);
  ~AppState();
  AppState(const AppState&) = delete;
  AppState& operator=(const AppState&) = delete;

  bool has_document() const;
  const render::Document& document() const;

  // All edits of the document. Edits with the same `gesture`, one after the other, make one step of undo.
  void edit(const render::DocumentParameter& parameter, const Value& value, const std::string& gesture = "");
  // Several parameters of one object in one step, which is named after the first parameter.
  void edit(std::span<const render::DocumentParameter> parameters, std::span<const Value> values,
            const std::string& gesture);
  void edit(render::Document changed, const std::string& name, const std::string& gesture = "");
  void edit_camera(const Camera& camera, const std::string& name, const std::string& gesture = "");
  // A parameter by its qualified name, in a step of its own. Does nothing if the document has no such parameter.
  void set_parameter(const std::string& name, const Value& value);

  // Why the integrator cannot render the scene, as one sentence; empty if it can or if that is not known yet.
  std::string incompatibility() const;
  // Opens a scene, a session, a snapshot or an environment map in the background.
  void open_file(const std::string& file);
  // Whether the integrator of an opened scene is chosen automatically. Not without stored settings: scripts and
  // off-screen runs give the same images on every machine.
  bool chooses_integrators() const { return !files.settings.empty() && settings.automatic_integrator; }
  // Writes the session file; asks for its name if it has none.
  void save_session();
  void save_session_as();
  // Opens the panel of a parameter and marks its widget.
  void show_parameter(const std::string& name);
  // Calls `proceed` at once if there are no unsaved edits of the scene, otherwise after the user has saved or discarded
  // them.
  void after_unsaved_edits(std::function<void(AppState&)> proceed);
  // Writes the settings file, unless settings are not kept.
  void store_settings();
  // Selects one node, and its material and light. A negative material stands for the first one of the node.
  void select(int node, int material);

  // Whether the panel is open and the interface is not hidden.
  bool is_visible(const Panel& panel) const { return interface.visible && panels.is_open(panel); }
  // Whether an AOV is shown instead of the image.
  bool shows_aov() const;

  bool is_active_tool(std::string_view name) const;
  // Activates a tool, or deactivates it if it is active. Replaces the tool that was active.
  void toggle_tool(ClickTool tool);

  Platform& platform;
  const ViewOptions options;
  Settings settings;
  Notices notices;
  UiContext ui;
  InterfaceState interface;
  Selection selection;
  MaterialClipboard material_clipboard;
  ActionList actions;
  std::string previous_integrator;  // for the action that switches back to it
  Timing timing;
  bool quit = false;
  bool stays_open = false;  // the random user of a script does not quit

  const std::unique_ptr<render::Session> session;
  const std::unique_ptr<Editor> editor;
  const SharedTasks tasks;
  const TaskContext task_context;
  FileState files;
  ViewportState viewport;
  PanelSet panels;
};

}  // namespace etendue::viewer
