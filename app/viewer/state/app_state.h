// Everything the viewer has on its desk; panels, actions and scripts work on this.
#pragma once
#include <chrono>
#include <span>

#include "render/session.h"
#include "viewer/actions/action.h"
#include "viewer/files/image_export.h"
#include "viewer/files/loader.h"
#include "viewer/files/scene_export.h"
#include "viewer/layout/file_dialog.h"
#include "viewer/platform/theme.h"
#include "viewer/script/item_registry.h"
#include "viewer/state/editor.h"
#include "viewer/state/notices.h"
#include "viewer/state/settings.h"
#include "viewer/tasks/convergence_task.h"
#include "viewer/tasks/missing_paths_task.h"
#include "viewer/tasks/path_class_task.h"
#include "viewer/tasks/pixel_samples_task.h"
#include "viewer/tasks/recommendation_task.h"
#include "viewer/tasks/surface_analysis.h"
#include "viewer/tasks/technique_task.h"
#include "viewer/tools/camera_controller.h"
#include "viewer/tools/light_meter.h"
#include "viewer/viewer.h"
#include "viewer/viewport/aov_layer.h"
#include "viewer/viewport/comparison.h"
#include "viewer/viewport/stored_points.h"
#include "viewer/widgets/thumbnails.h"

namespace etendue::viewer {

enum class Tab : uint8_t { render, scene, material, light, camera, display };

struct Selection {
  int node = -1, material = -1, light = -1;
};

// What the sheet about one pixel's samples shows.
struct SamplingView {
  uint32_t samples = 4096;                   // to draw
  std::string x = "pixel-x", y = "pixel-y";  // of the points
  uint32_t points = 512;
  bool picks = false;  // the next click chooses the pixel

  friend bool operator==(const SamplingView&, const SamplingView&) = default;
};

// What is shown and how; none of it changes the light, none of it is a step.
struct View {
  Placement region;   // of the window, for the picture
  Placement picture;  // the picture in it
  bool interface = true, help = false, palette = false;
  bool covered = false;  // something lies over the interface that Escape closes
  bool typing = false;   // a text field has the keyboard
  bool false_color = false;
  bool health_map = false;
  bool points = false;  // photons and virtual lights over the picture
  std::string aov;      // the layer shown instead of the picture
  Tab tab = Tab::render;
  std::optional<Tab> reveal;    // the tab to bring to the front in the next frame
  bool focus_by_click = false;  // the next click sets the focus
  float column = 0;             // width of the right column, pixels
  std::string sheet;            // the one that the drawer shows; empty if it is closed
  SamplingView sampling;
};

// How the interface spends its time.
struct Pace {
  double busy = 0, since_start = 0;  // seconds of this measurement
  double share = 0;                  // of the last one
};

// The angles that the hand gave to a rotation, for as long as it is still that one.
struct Turned {
  std::string name;
  Vec4 rotation{0};
  Vec3 degrees{0};
};

// The text that a field was last asked about, and the answer: a file is not read again for every frame.
struct CheckedText {
  std::string field, text;
  Result<void> answer;
};

struct Workbench {
  Workbench(Platform& p, const ViewOptions& o);

  // Reads a file in the background; what it is decides what happens.
  void open(const std::string& file);
  void save_snapshot(const std::string& file) { capture.request(file); }

  // All edits end here. `gesture` as in Editor.
  void edit(const render::DocumentParameter& binding, const Value& value, const std::string& gesture = "");
  // Several settings of one thing in one step; the first gives it its name.
  void edit(std::span<const render::DocumentParameter> bindings, std::span<const Value> values,
            const std::string& gesture);
  void edit(render::Document changed, const std::string& name, const std::string& gesture = "") {
    editor.apply(std::move(changed), name, gesture);
  }
  void edit_camera(const Camera& camera, const std::string& name, const std::string& gesture);
  void choose_integrator(const std::string& name);
  // Has only these paths count, in a step of its own; all of them if the expression is empty.
  void choose_paths(const std::string& expression);

  void select(int node, int material);
  void focus_at(const Picked& picked);
  void frame_scene();
  void frame_selection();

  // Takes up what came from other threads since the last frame; true if the picture has to be drawn again.
  bool advance(Picture& picture_on_screen);

  // Why the method finds no light at all in the picture on the desk; empty if it may, or as long as that is not known.
  std::string incompatibility() const;
  // What the method misses of the view on the desk, as far as it was measured; null if it was not.
  const advisor::MissingPaths* misses();

  // A layer stands in the picture's place.
  bool shows_layer() const { return !view.aov.empty() && aov.picture().name == view.aov; }
  void show_tab(Tab tab) { view.tab = tab, view.reveal = tab; }

  Platform& platform;
  ViewOptions options;
  Settings settings;
  render::Session session;
  Editor editor{session};
  Actions actions;
  Items items;
  Notices notices;
  Loader loader;
  Capture capture;
  SceneWriter scene_writer;
  AovView aov;
  Comparison comparison;
  ContestHand contest;
  PathsHand paths;
  BlindSpotsHand missing_paths;
  TechniquesHand techniques;
  PointsHand points;
  Thumbnails thumbnails;  // of the techniques
  SurfaceHand surface;
  Thumbnails balls;  // of its materials
  AdviceHand advice;
  PixelProbe probe;
  MeterHand meter;
  CameraHand hand;
  FileDialog files;
  Selection selection;
  Turned turned;
  CheckedText checked;
  View view;
  Theme theme;
  Faces faces;
  Input input;
  double pointer_rest = 0;  // seconds since the pointer moved or pressed
  Pace pace;
  std::shared_ptr<const render::Frame> frame;  // on screen
  double first_picture_seconds = 0;            // from the start of the process until a picture was on screen
  std::string previous_integrator;             // what Tab goes back to
  std::string last_opened;
  bool quit = false;

 private:
  void take_opened(Result<Opened> opened);
  bool needs_pivot_ = false;
  bool shows_aov_ = false;
};

// The size of a picture that fills the region, and where a picture of a given shape lies in it.
Placement fitted(const Placement& region, Vec2i picture);

}  // namespace etendue::viewer
