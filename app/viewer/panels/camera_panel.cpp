// The camera: projection, lens, focus, position and orientation.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "camera/lens_units.h"
#include "render/document.h"
#include "render/session.h"
#include "viewer/panels/object_names.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/viewport/first_view.h"
#include "viewer/viewport/viewport.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/number_widget.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

constexpr const char* kFocusTool = "camera.focus-by-click";

// Takes position, projection and aspect ratio from a camera of the file. The image keeps its height.
void use_camera(AppState& state, const Camera& camera) {
  render::Document changed = state.document();
  changed.camera = camera;
  changed.camera_name = camera.name;
  if (camera.aspect > 0)
    changed.width = std::max(1, static_cast<int>(std::lround(static_cast<float>(changed.height) * camera.aspect)));
  const auto scene = state.session->scene();
  if (scene) changed.camera = camera_for_navigation(changed, *scene);
  if (scene) state.viewport.camera_controller.reset_pivot(changed.camera, *scene);
  state.edit(std::move(changed), "Camera " + camera.name);
}

void camera_combo(AppState& state) {
  const auto cameras = scene::placed_cameras(*state.document().scene);
  if (cameras.empty()) return note(state.ui, "The file has no camera. The default camera shows the whole scene.");
  label_column("Camera");
  size_t current = cameras.size();
  for (size_t i = 0; i < cameras.size(); ++i)
    if (cameras[i].to_world == state.document().camera.to_world) current = i;
  const auto name = [&](size_t i) { return object_name(cameras[i].name, "camera", i); };
  if (begin_combo("##camera", current < cameras.size() ? name(current).c_str() : "User view")) {
    for (size_t i = 0; i < cameras.size(); ++i) {
      ImGui::PushID(static_cast<int>(i));
      if (ImGui::Selectable(name(i).c_str(), i == current)) use_camera(state, cameras[i]);
      ImGui::PopID();
      state.ui.items.add("camera.choose." + std::to_string(i));
    }
    ImGui::EndCombo();
  }
  state.ui.items.add("camera.choose");
  if (ImGui::IsItemHovered()) tooltip(state.ui, "Cameras of the file");
}

// The size parameter that does not belong to the projection is shown only if a script requests it.
void projection_widgets(AppState& state) {
  const bool perspective = state.document().camera.projection == Projection::perspective;
  const ItemRegistry& items = state.ui.items;
  section_widgets_for(state, "camera", {"projection"});
  if (perspective || items.is_requested("camera.yfov")) section_widgets_for(state, "camera", {"yfov"});
  if (!perspective || items.is_requested("camera.ymag")) section_widgets_for(state, "camera", {"ymag"});
  section_widgets_for(state, "camera", {"near-clip"});
}

void focus_checkbox(AppState& state) {
  bool active = state.is_active_tool(kFocusTool);
  const bool toggled = ImGui::Checkbox("Focus by click", &active);
  state.ui.items.add(kFocusTool);
  if (ImGui::IsItemHovered())
    tooltip(state.ui, "The next click in the image sets the focus distance. A double click does so at any time");
  if (!toggled) return;
  const auto use = [](AppState& s, Vec2 position) {
    if (!focus_at(s, position)) return false;
    select_at(s, position);
    return true;
  };
  state.toggle_tool({.name = kFocusTool, .use = use});
  if (active) state.notices.add_message("Click the surface to focus on.");
}

// The lens in the terms of photography. Lengths are in millimetres.
struct PhotographicLens {
  Number<float> sensor_height{
      "lens.sensor-height",
      "Sensor height",
      static_cast<float>(kFullFrameHeight),
      {0.1f, 1000},
      "Converts angles of view to focal lengths; it does not change the image. 24 is full frame, 15.6 "
      "APS-C, 13 Micro Four Thirds",
      "mm",
      Scale::logarithmic};
  Number<float> focal_length{"lens.focal-length",
                             "Focal length",
                             50,
                             {0.01f, 1e6f},
                             "Longer lenses have a smaller field of view. The f-number stays",
                             "mm",
                             Scale::logarithmic};
  Number<float> f_number{
      "lens.f-number",
      "f-number",
      0,
      {0, 1e6f},
      "Focal length divided by the diameter of the lens. Smaller numbers have a shallower depth of field; "
      "0: pinhole",
      "",
      Scale::logarithmic};
  auto all() { return std::tie(sensor_height, focal_length, f_number); }

  void read(const Camera& camera) {
    const double f = etendue::focal_length(static_cast<double>(camera.yfov), static_cast<double>(sensor_height.value));
    focal_length.value = static_cast<float>(f);
    f_number.value = static_cast<float>(etendue::f_number(f, 1000 * static_cast<double>(camera.lens_radius)));
  }
  Camera applied_to(Camera camera) const {
    const auto f = static_cast<double>(focal_length.value);
    constexpr double kLeastAngle = 1e-3, kLargestAngle = 3.1;  // of camera.yfov
    const double angle = angle_of_view(f, static_cast<double>(sensor_height.value));
    camera.yfov = static_cast<float>(std::clamp(angle, kLeastAngle, kLargestAngle));
    camera.lens_radius = static_cast<float>(lens_radius(f, static_cast<double>(f_number.value)) / 1000);
    return camera;
  }
};

class CameraPanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "tab.camera",
            .label = "Camera",
            .description = "Projection, lens, focus, position and orientation of the camera",
            .place = PanelPlace::right_column};
  }

  void draw(AppState& state) override {
    const UiContext& ui = state.ui;
    camera_combo(state);
    action_button(state, "view.frame-all");
    ImGui::SameLine();
    action_button(state, "view.frame-selection");
    action_button(state, "view.reset-camera");
    ImGui::SameLine();
    action_button(state, "add.camera");
    if (group(ui, "Projection", "camera.")) projection_widgets(state);
    if (group(ui, "Lens", "camera.")) {
      section_widgets_for(state, "camera", {"lens-radius", "focus-distance", "shutter"});
      focus_checkbox(state);
    }
    if (group(ui, "Photographic lens", "lens.", false)) draw_photographic_lens(state);
    if (group(ui, "Position", "camera.eye.")) section_widgets_for(state, "camera", {"eye.x", "eye.y", "eye.z"});
    const bool axis_requested = ui.items.is_requested_below("camera.right") ||
                                ui.items.is_requested_below("camera.up") || ui.items.is_requested_below("camera.back");
    if (axis_requested) ImGui::SetNextItemOpen(true);
    if (group(ui, "Orientation", "", false))
      section_widgets_for(state, "camera",
                          {"right.x", "right.y", "right.z", "up.x", "up.y", "up.z", "back.x", "back.y", "back.z"});
  }

  std::vector<ParameterInfo> parameters() const override { return describe_all(PhotographicLens().all()); }

  // The lens of the opened file, by the sensor that is set now.
  std::optional<Value> default_value(const AppState& state, const std::string& name) const override {
    PhotographicLens lens;
    if (name != lens.sensor_height.name) lens.sensor_height = lens_.sensor_height;
    if (const auto& origin = state.document().origin) lens.read(origin->camera);
    const auto list = describe_all(lens.all());
    const ParameterInfo* info = find_parameter(list, name);
    return info ? std::optional(info->default_value) : std::nullopt;
  }

  std::vector<ItemInfo> items() const override {
    return {{"camera.choose", "Camera", "Opens the list of the cameras of the file"},
            {"camera.choose.N", "Camera N", "Uses camera N of the open list"},
            {kFocusTool, "Focus by click", "The next click in the image sets the focus distance"}};
  }

  bool reveal_parameter(AppState&, const std::string& name) override {
    // The exposure is in the Display panel.
    return (name.starts_with("camera.") && name != "camera.exposure") || name.starts_with("lens.");
  }

 private:
  // Focal length and f-number are edits of the field of view and the lens radius.
  void draw_photographic_lens(AppState& state) {
    if (state.document().camera.projection != Projection::perspective)
      return note(state.ui, "Only perspective cameras have a focal length and an f-number.");
    lens_.read(state.document().camera);
    const auto edited = [&](Number<float>& number) {
      const auto value = parameter_widget(state, describe(number));
      if (value) number.value = static_cast<float>(std::get<double>(*value));
      return value.has_value();
    };
    edited(lens_.sensor_height);
    const auto apply = [&](const char* name, const char* gesture) {
      state.edit_camera(lens_.applied_to(state.document().camera), name, gesture);
      is_edited_ = true;
    };
    if (edited(lens_.focal_length)) apply("Focal length", "lens.focal-length");
    if (edited(lens_.f_number)) apply("f-number", "lens.f-number");
    // A drag is one step of undo.
    if (!is_edited_ || ImGui::IsAnyItemActive()) return;
    state.editor->end_gesture();
    is_edited_ = false;
  }

  PhotographicLens lens_;
  bool is_edited_ = false;  // since the last end of a gesture
};

}  // namespace

std::unique_ptr<Panel> make_camera_panel() { return std::make_unique<CameraPanel>(); }

}  // namespace etendue::viewer
