#include "viewer/viewport/viewport.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <cmath>
#include <optional>

#include "render/session.h"
#include "scene/compiled_scene.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"
#include "viewer/state/object_edits.h"
#include "viewer/viewport/first_view.h"
#include "viewer/viewport/lit_view.h"
#include "viewer/viewport/object_icons.h"
#include "viewer/viewport/picking.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr float kClickTolerance = 4;           // pixels that the pointer may move during a click
constexpr double kScrollGestureSeconds = 0.6;  // a longer pause starts a new step of undo
constexpr float kFlySpeedFactor = 1.25f;       // per notch of the wheel
constexpr float kZoomFactor = 1.25f;           // of the image, per notch of the wheel
constexpr float kMaxFlySeconds = 0.2f;         // longest time step, so that a slow frame causes no jump

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::optional<PickedSurface> pick_at(const AppState& state, Vec2 position) {
  const auto scene = state.session->scene();
  return scene ? pick(state.document(), *scene, state.viewport.image, position) : std::nullopt;
}

// The direction of flight from the keys W, A, S, D, Q and E, in camera coordinates.
Vec3 fly_direction(const Input& input) {
  const auto axis = [&](int positive, int negative) {
    return (input.keys[static_cast<size_t>(positive)] ? 1.0f : 0.0f) -
           (input.keys[static_cast<size_t>(negative)] ? 1.0f : 0.0f);
  };
  return {axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_S, GLFW_KEY_W)};
}

bool use_tool(AppState& state, Vec2 position) {
  if (!state.viewport.click_tool || !state.viewport.image.contains(position)) return false;
  // The tool may activate another one, so it is copied.
  const ClickTool tool = *state.viewport.click_tool;
  if (!tool.use(state, position)) return false;
  if (state.is_active_tool(tool.name)) state.viewport.click_tool.reset();
  return true;
}

bool use_panel(AppState& state, Vec2 position) {
  if (!state.viewport.image.contains(position)) return false;
  for (const auto& panel : state.panels.all())
    if (state.panels.is_open(*panel) && panel->handle_click(state, position)) return true;
  return false;
}

}  // namespace

void ViewportController::handle_input(AppState& state, float seconds) {
  if (!state.has_document()) return;
  const Input& input = state.ui.input;
  const bool hovered = !ImGui::GetIO().WantCaptureMouse && state.viewport.region.contains(input.mouse);
  const bool moves_divider = drag_ == Drag::none && divider_.handle_input(state, hovered);
  // A click with an active tool belongs to the tool, also over the handles.
  const bool reaches_handles = hovered && !state.viewport.click_tool && !state.viewport.focus.is_selecting();
  const bool moves_object =
      drag_ == Drag::none && !moves_divider && state.viewport.gizmo.handle_input(state, reaches_handles);
  if (drag_ == Drag::none && hovered && !moves_divider && !moves_object) begin_drag(state);
  if (drag_ != Drag::none) {
    continue_drag(state);
    if (drag_ == Drag::fly) fly(state, seconds);
    end_drag(state);
  }
  if (input.wheel != 0 && hovered && input.control()) return zoom_image(state);
  if (input.wheel != 0 && (hovered || drag_ == Drag::fly)) scroll(state);
}

void ViewportController::begin_drag(AppState& state) {
  const Input& input = state.ui.input;
  const auto pressed = [&](Button b) { return input.pressed[static_cast<size_t>(b)]; };
  if (pressed(Button::left)) drag_ = input.shift() ? Drag::pan : Drag::orbit;
  // A fitted image has nothing beyond the viewport, so the camera moves.
  if (pressed(Button::middle)) drag_ = state.viewport.zoom.is_fitted() ? Drag::pan : Drag::move_image;
  if (pressed(Button::right)) drag_ = input.shift() ? Drag::environment : Drag::fly;
  if (drag_ == Drag::orbit && state.viewport.focus.is_selecting()) drag_ = Drag::region;
  if (drag_ == Drag::none) return;
  for (const Button button : {Button::left, Button::middle, Button::right})
    if (pressed(button)) button_ = button;
  state.editor->end_gesture();
  drag_start_ = input.mouse;
  last_position_ = input.mouse;
  moved_ = false;
}

void ViewportController::continue_drag(AppState& state) {
  const Vec2 position = state.ui.input.mouse;
  const Vec2 movement = position - last_position_;
  if (glm::length(position - drag_start_) > kClickTolerance) moved_ = true;
  if (!moved_ || movement == Vec2(0)) return;
  last_position_ = position;
  const Camera& camera = state.document().camera;
  CameraController& controller = state.viewport.camera_controller;
  const float height = state.viewport.image.size.y;
  if (drag_ == Drag::region) state.viewport.focus.drag(state, drag_start_, position);
  if (drag_ == Drag::move_image) state.viewport.zoom = moved(state, movement);
  if (drag_ == Drag::orbit) state.edit_camera(controller.orbit(camera, movement), "Orbit", "camera.orbit");
  if (drag_ == Drag::pan) state.edit_camera(controller.pan(camera, movement, height), "Pan", "camera.pan");
  if (drag_ == Drag::environment) turn_environment(state, movement.x);
  if (drag_ == Drag::fly) state.edit_camera(controller.look_around(camera, movement), "Fly", "camera.fly");
}

void ViewportController::fly(AppState& state, float seconds) {
  const Vec3 direction = fly_direction(state.ui.input);
  if (direction == Vec3(0)) return;
  moved_ = true;
  const CameraController& controller = state.viewport.camera_controller;
  state.edit_camera(controller.fly(state.document().camera, direction, std::min(seconds, kMaxFlySeconds)), "Fly",
                    "camera.fly");
}

void ViewportController::turn_environment(AppState& state, float movement) {
  const auto parameter = document_parameter(state.document(), "environment.rotation");
  if (!parameter || state.document().scene->environment.black()) return;
  const double turn = 2 * static_cast<double>(kPi);
  const double angle = std::get<double>(parameter->info.default_value) +
                       turn * static_cast<double>(movement / std::max(state.viewport.image.size.x, 1.0f));
  state.edit(*parameter, Value(std::remainder(angle, turn)), "environment.turn");
}

void ViewportController::end_drag(AppState& state) {
  const auto& buttons = state.ui.input.buttons;
  const auto is_down = [&](Button b) { return buttons[static_cast<size_t>(b)]; };
  const bool is_right = button_ == Button::right;
  const bool held = is_right ? is_down(Button::right) : is_down(Button::left) || is_down(Button::middle);
  if (held) return;
  if (drag_ == Drag::region) state.viewport.focus.end_drag();
  const bool is_left = drag_ == Drag::orbit || (drag_ == Drag::pan && button_ == Button::left);
  if (is_left && !moved_) click(state, drag_start_);
  if (drag_ == Drag::fly && !moved_) state.interface.menu_position = drag_start_;
  if (drag_ == Drag::fly && moved_) {
    // After a flight, the camera orbits the point at the image centre. The speed stays.
    CameraController& controller = state.viewport.camera_controller;
    const float speed = controller.fly_speed();
    if (const auto scene = state.session->scene()) controller.reset_pivot(state.document().camera, *scene);
    controller.set_fly_speed(speed);
  }
  drag_ = Drag::none;
  state.editor->end_gesture();
}

void ViewportController::click(AppState& state, Vec2 position) {
  if (state.ui.input.shift() || state.ui.input.control()) return extend_selection_at(state, position);
  if (use_tool(state, position) || use_panel(state, position) || select_icon_at(state, position)) return;
  const bool is_double = seconds_since(click_time_) < static_cast<double>(ImGui::GetIO().MouseDoubleClickTime) &&
                         glm::length(position - click_position_) <= kClickTolerance;
  click_time_ = is_double ? Clock::time_point{} : Clock::now();
  click_position_ = position;
  if (is_double) focus_at(state, position);
  select_at(state, position);
}

void ViewportController::scroll(AppState& state) {
  CameraController& controller = state.viewport.camera_controller;
  const float notches = state.ui.input.wheel;
  if (drag_ == Drag::fly) return controller.set_fly_speed(controller.fly_speed() * std::pow(kFlySpeedFactor, notches));
  if (seconds_since(scroll_time_) > kScrollGestureSeconds) state.editor->end_gesture();
  scroll_time_ = Clock::now();
  const auto picked = pick_at(state, state.ui.input.mouse);
  const Vec3 target = picked ? picked->position : controller.pivot();
  state.edit_camera(controller.dolly(state.document().camera, target, notches), "Dolly", "camera.dolly");
}

void ViewportController::zoom_image(AppState& state) {
  const Input& input = state.ui.input;
  state.viewport.zoom = scaled(state, std::pow(kZoomFactor, input.wheel), input.mouse);
}

namespace {

// Opens the panel of the selected object, unless the Scene panel is open, which shows all objects.
void show_panel_of_selection(AppState& state) {
  const Panel* open = state.panels.open_tab();
  if (open && std::string_view(open->info().name) == "tab.scene") return;
  const auto& node = state.document().scene->nodes[static_cast<size_t>(state.selection.node)];
  if (Panel* panel = state.panels.find(node.light >= 0 ? "tab.light" : "tab.material")) state.panels.open(*panel);
}

}  // namespace

bool focus_at(AppState& state, Vec2 position) {
  const auto picked = pick_at(state, position);
  if (!picked) return false;
  state.viewport.camera_controller.set_pivot(picked->position);
  Camera camera = state.document().camera;
  camera.focus_distance = picked->axial_distance;
  if (!(camera == state.document().camera)) state.edit_camera(camera, "Focus");
  state.notices.add_message(
      formatted("Focus distance and orbit centre: %.4g m", static_cast<double>(picked->axial_distance)));
  return true;
}

void select_at(AppState& state, Vec2 position) {
  const auto picked = pick_at(state, position);
  if (!picked) {
    state.selection.node = -1;
    state.selection.others.clear();
    return;
  }
  state.select(picked->node, picked->material);
  if (state.selection.node >= 0) show_panel_of_selection(state);
}

void extend_selection_at(AppState& state, Vec2 position) {
  if (const int icon = icon_at(state, position); icon >= 0) return toggle_selected(state, icon, -1);
  if (const auto picked = pick_at(state, position)) toggle_selected(state, picked->node, picked->material);
}

namespace {

// The camera looks at something else: the focus of a pinhole and its near plane follow.
void use_view(AppState& state, const Camera& camera, const scene::CompiledScene& scene, const char* name) {
  render::Document changed = state.document();
  changed.camera = camera;
  if (camera.lens_radius == 0) changed.camera.focus_distance = Camera{}.focus_distance;
  state.edit_camera(camera_for_navigation(changed, scene), name);
}

}  // namespace

void frame_scene(AppState& state) {
  const auto scene = state.session->scene();
  if (!state.has_document() || !scene) return;
  const auto& d = state.document();
  const float aspect = static_cast<float>(d.width) / static_cast<float>(d.height);
  const Camera framed = state.viewport.camera_controller.frame(d.camera, scene->bounds(), aspect);
  const Camera lit = lit_camera(*scene, framed, aspect);
  state.viewport.pivot_is_outdated = !(lit == framed);
  use_view(state, lit, *scene, "Frame all");
}

void reset_view(AppState& state) {
  const auto scene = state.session->scene();
  if (!state.has_document() || !scene) return;
  render::Document changed = state.document();
  changed.camera = reset_camera(changed, *scene);
  changed.camera = camera_for_navigation(changed, *scene);
  state.viewport.pivot_is_outdated = true;
  state.edit(std::move(changed), "Reset camera");
}

void frame_selection(AppState& state) {
  const auto scene = state.session->scene();
  if (!state.has_document() || !scene) return;
  Bounds bounds;
  for (const int node : selected_nodes(state)) bounds.extend(bounds_of_node(*scene, node));
  if (bounds.empty()) return frame_scene(state);
  const auto& d = state.document();
  const float aspect = static_cast<float>(d.width) / static_cast<float>(d.height);
  use_view(state, state.viewport.camera_controller.frame(d.camera, bounds, aspect), *scene, "Frame selection");
}

}  // namespace etendue::viewer
