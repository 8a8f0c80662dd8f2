#include "viewer/tools/gizmo.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "render/document.h"
#include "render/session.h"
#include "scene/compiled_scene.h"
#include "scene/keyframes.h"
#include "scene/pose.h"
#include "scene/rotation.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/state/object_edits.h"
#include "viewer/tools/gizmo_view.h"
#include "viewer/viewport/picking.h"
#include "viewer/widgets/scale_bar.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

using Kind = GizmoHandle::Kind;

constexpr float kAxisPixels = 90;   // length of an axis at scale 1
constexpr float kGrabPixels = 8;    // distance from a handle within which it is grabbed
constexpr float kPlaneFrom = 0.3f;  // corners of the squares that stand for planes, relative to an axis
constexpr float kPlaneTo = 0.5f;
constexpr int kRingSegments = 64;
constexpr float kSnapDegrees = 15;
constexpr float kSnapFactor = 0.1f;
constexpr float kMinFactor = 0.01f;  // a scale of zero could not be undone by scaling
constexpr const char* kGizmoGesture = "gizmo";
constexpr std::array<ImU32, 3> kAxisColors{IM_COL32(230, 80, 70, 255), IM_COL32(110, 190, 60, 255),
                                           IM_COL32(80, 140, 240, 255)};
constexpr ImU32 kActiveColor = IM_COL32(255, 210, 60, 255);
constexpr ImU32 kUniformColor = IM_COL32(235, 235, 235, 255);
constexpr std::array<const char*, 3> kAxisNames{"x", "y", "z"};

// The next lower power of ten to a twentieth of the size of the scene.
float snap_length(const AppState& state) {
  const auto scene = state.session->scene();
  const float radius = scene && !scene->bounds().empty() ? scene->bounds().radius() : 1.0f;
  return std::pow(10.0f, std::floor(std::log10(std::max(radius, 1e-6f) / 20)));
}

float rounded_to(float value, float step) { return std::round(value / step) * step; }

Vec3 perpendicular_of(const Vec3& axis) {
  const Vec3 other = std::abs(axis.x) < 0.7f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  return glm::normalize(glm::cross(axis, other));
}

// The points of a ring about an axis.
std::array<Vec3, kRingSegments + 1> ring(const Vec3& origin, const Vec3& axis, float radius) {
  const Vec3 u = perpendicular_of(axis), v = glm::cross(axis, u);
  std::array<Vec3, kRingSegments + 1> points;
  for (size_t i = 0; i < points.size(); ++i) {
    const float phi = 2 * kPi * static_cast<float>(i) / kRingSegments;
    points[i] = origin + (u * std::cos(phi) + v * std::sin(phi)) * radius;
  }
  return points;
}

// The corners of the square that stands for the plane perpendicular to an axis.
std::array<Vec3, 4> plane_square(const Vec3& origin, const Mat3& axes, int axis, float length) {
  const Vec3 u = axes[(axis + 1) % 3] * length, v = axes[(axis + 2) % 3] * length;
  return {origin + u * kPlaneFrom + v * kPlaneFrom, origin + u * kPlaneTo + v * kPlaneFrom,
          origin + u * kPlaneTo + v * kPlaneTo, origin + u * kPlaneFrom + v * kPlaneTo};
}

// An animated object is moved by its keyframes.
bool is_movable(const scene::Scene& scene, int node) {
  if (scene.nodes[static_cast<size_t>(node)].skin >= 0) return false;
  return !scene::has_animated_transform(scene, node) || scene::keyframe_obstacle(scene, node).empty();
}

ImVec2 to_im(Vec2 p) { return {p.x, p.y}; }

ImU32 color_of(const GizmoHandle& handle) {
  return handle.kind == Kind::uniform ? kUniformColor : kAxisColors[static_cast<size_t>(handle.axis)];
}

// Draws handles. Lines have a dark border, so that they are visible over any image.
class GizmoPainter {
 public:
  GizmoPainter(const GizmoView& view, ImDrawList& draw, float unit) : view_(view), draw_(draw), unit_(unit) {}

  // A line that ends in a disk, or in a box.
  void axis(const Vec3& from, const Vec3& tip, bool has_box, ImU32 color) const {
    line(from, tip, kBorder, 5);
    line(from, tip, color, 2.5f);
    const auto end = view_.project(tip);
    if (!end) return;
    const float half = 5 * unit_;
    if (has_box)
      draw_.AddRectFilled({end->x - half, end->y - half}, {end->x + half, end->y + half}, color);
    else
      draw_.AddCircleFilled(to_im(*end), half, color);
  }

  void ring(const std::array<Vec3, kRingSegments + 1>& points, ImU32 color) const {
    for (size_t i = 0; i + 1 < points.size(); ++i) line(points[i], points[i + 1], kBorder, 4);
    for (size_t i = 0; i + 1 < points.size(); ++i) line(points[i], points[i + 1], color, 2);
  }

  void plane(const std::array<Vec3, 4>& corners, ImU32 color) const {
    std::array<ImVec2, 4> points;
    for (size_t i = 0; i < corners.size(); ++i) {
      const auto p = view_.project(corners[i]);
      if (!p) return;
      points[i] = to_im(*p);
    }
    draw_.AddConvexPolyFilled(points.data(), 4, (color & ~IM_COL32_A_MASK) | IM_COL32(0, 0, 0, 150));
  }

  void centre(const Vec3& point, ImU32 color) const {
    if (const auto p = view_.project(point)) draw_.AddCircleFilled(to_im(*p), 7 * unit_, color);
  }

 private:
  static constexpr ImU32 kBorder = IM_COL32(0, 0, 0, 130);

  void line(const Vec3& from, const Vec3& to, ImU32 color, float width) const {
    const auto a = view_.project(from), b = view_.project(to);
    if (a && b) draw_.AddLine(to_im(*a), to_im(*b), color, width * unit_);
  }

  GizmoView view_;
  ImDrawList& draw_;
  float unit_;
};

}  // namespace

std::optional<Gizmo::Frame> Gizmo::frame_of(const AppState& state) const {
  if (mode == GizmoMode::off || !state.has_document() || state.selection.node < 0) return std::nullopt;
  const scene::Scene& scene = *state.document().scene;
  const int index = state.selection.node;
  const scene::Node& node = scene.nodes[static_cast<size_t>(index)];
  // Joints, animations that cannot be edited, or the type of the object decide.
  if (!is_movable(scene, index)) return std::nullopt;
  if (mode == GizmoMode::scale && (node.light >= 0 || node.camera >= 0)) return std::nullopt;
  if (mode != GizmoMode::move && !scene::decompose(node.transform)) return std::nullopt;
  const std::vector<Mat4>& world = state.viewport.node_places.of(state.document().scene).world;
  Frame frame;
  frame.to_world = world[static_cast<size_t>(index)];
  if (node.parent >= 0) frame.parent = world[static_cast<size_t>(node.parent)];
  if (scene::is_singular(frame.to_world) || scene::is_singular(frame.parent)) return std::nullopt;
  frame.origin = Vec3(frame.to_world * Vec4(mesh_centre_.of(scene, index), 1));
  // A scale acts along the axes of the object.
  if (local || mode == GizmoMode::scale)
    for (int c = 0; c < 3; ++c) frame.axes[c] = glm::normalize(Vec3(frame.to_world[c]));
  const GizmoView view(state.document(), state.viewport.image);
  frame.length = kAxisPixels * state.ui.scale * view.pixel_size(frame.origin);
  return frame;
}

std::vector<GizmoHandle> Gizmo::handles() const {
  std::vector<GizmoHandle> list;
  // Planes and the centre cover the axes, so they are first.
  if (mode == GizmoMode::scale) list.push_back({Kind::uniform, 0});
  for (int axis = 0; axis < 3 && mode == GizmoMode::move; ++axis) list.push_back({Kind::plane, axis});
  for (int axis = 0; axis < 3; ++axis) list.push_back({Kind::axis, axis});
  return list;
}

std::optional<GizmoHandle> Gizmo::handle_at(const AppState& state, const Frame& frame, Vec2 position) const {
  const GizmoView view(state.document(), state.viewport.image);
  const auto distance_to = [&](const auto& points) {
    float nearest = kInfinity;
    for (size_t i = 0; i + 1 < points.size(); ++i) {
      const auto a = view.project(points[i]), b = view.project(points[i + 1]);
      if (a && b) nearest = std::min(nearest, distance_to_segment(position, *a, *b));
    }
    return nearest;
  };
  const auto distance = [&](const GizmoHandle& handle) {
    const Vec3 axis = frame.axes[handle.axis];
    if (handle.kind == Kind::uniform) return distance_to(std::array{frame.origin, frame.origin});
    if (handle.kind == Kind::plane) {
      const auto corners = plane_square(frame.origin, frame.axes, handle.axis, frame.length);
      return distance_to(std::array{(corners[0] + corners[1]) * 0.5f, (corners[2] + corners[3]) * 0.5f});
    }
    if (mode == GizmoMode::rotate) return distance_to(ring(frame.origin, axis, frame.length));
    return distance_to(std::array{frame.origin + axis * (0.2f * frame.length), frame.origin + axis * frame.length});
  };
  const float grab = kGrabPixels * state.ui.scale;
  std::optional<GizmoHandle> result;
  float nearest = grab;
  for (const GizmoHandle& handle : handles()) {
    const float d = distance(handle);
    if (d < nearest) {
      nearest = d;
      result = handle;
    }
  }
  return result;
}

std::optional<Gizmo::Change> Gizmo::movement(const AppState& state, Vec2 position) const {
  const Frame& frame = drag_->frame;
  const GizmoView view(state.document(), state.viewport.image);
  const Ray from = view.ray(drag_->start), to = view.ray(position);
  const Vec3 axis = frame.axes[drag_->handle.axis];
  const bool snaps = state.ui.input.control();
  const float step = snap_length(state);
  Change change;
  if (drag_->handle.kind == Kind::axis) {
    const auto a = nearest_on_line(frame.origin, axis, from), b = nearest_on_line(frame.origin, axis, to);
    if (!a || !b) return std::nullopt;
    const float distance = snaps ? rounded_to(*b - *a, step) : *b - *a;
    change.translation = axis * distance;
    change.text =
        formatted("%s %+.4g m", kAxisNames[static_cast<size_t>(drag_->handle.axis)], static_cast<double>(distance));
  } else {
    const auto a = meet_plane(frame.origin, axis, from), b = meet_plane(frame.origin, axis, to);
    if (!a || !b) return std::nullopt;
    const Vec3 delta = *b - *a;
    for (const int other : {(drag_->handle.axis + 1) % 3, (drag_->handle.axis + 2) % 3}) {
      const float along = glm::dot(delta, frame.axes[other]);
      const float distance = snaps ? rounded_to(along, step) : along;
      change.translation += frame.axes[other] * distance;
      change.text += (change.text.empty() ? "" : ", ") +
                     formatted("%s %+.4g m", kAxisNames[static_cast<size_t>(other)], static_cast<double>(distance));
    }
  }
  change.matrix = glm::translate(Mat4(1), change.translation);
  return change;
}

std::optional<Gizmo::Change> Gizmo::rotation(const AppState& state, Vec2 position) const {
  const Frame& frame = drag_->frame;
  const GizmoView view(state.document(), state.viewport.image);
  const auto centre = view.project(frame.origin);
  if (!centre) return std::nullopt;
  const Vec3 axis = frame.axes[drag_->handle.axis];
  const float towards = glm::dot(axis, view.towards_camera(frame.origin));
  // The angle in the plane of the ring; a ring that is seen from the side turns with the pointer on the screen.
  constexpr float kFlatRing = 0.15f;
  float angle = 0;
  const auto a = meet_plane(frame.origin, axis, view.ray(drag_->start));
  const auto b = meet_plane(frame.origin, axis, view.ray(position));
  if (std::abs(towards) > kFlatRing && a && b) {
    const Vec3 from = *a - frame.origin, to = *b - frame.origin;
    angle = std::atan2(glm::dot(axis, glm::cross(from, to)), glm::dot(from, to));
  } else {
    const auto across =
        view.project(frame.origin + glm::cross(axis, view.towards_camera(frame.origin)) * -frame.length);
    if (!across) return std::nullopt;
    const Vec2 tangent = *across - *centre;
    const float length = std::max(glm::length(tangent), 1.0f);
    angle = -glm::dot(position - drag_->start, tangent) / (length * length);
  }
  float degrees = glm::degrees(angle);
  if (state.ui.input.control()) degrees = rounded_to(degrees, kSnapDegrees);
  Change change;
  change.matrix = glm::translate(Mat4(1), frame.origin) * glm::rotate(Mat4(1), glm::radians(degrees), axis) *
                  glm::translate(Mat4(1), -frame.origin);
  change.text =
      formatted("%s %+.1f\u00b0", kAxisNames[static_cast<size_t>(drag_->handle.axis)], static_cast<double>(degrees));
  return change;
}

std::optional<Gizmo::Change> Gizmo::scaling(const AppState& state, Vec2 position) const {
  const Frame& frame = drag_->frame;
  const GizmoView view(state.document(), state.viewport.image);
  float factor = 1;
  const bool is_uniform = drag_->handle.kind == Kind::uniform;
  if (is_uniform) {
    factor = 1 + (position.x - drag_->start.x) / (kAxisPixels * state.ui.scale);
  } else {
    const Vec3 axis = frame.axes[drag_->handle.axis];
    const auto a = nearest_on_line(frame.origin, axis, view.ray(drag_->start));
    const auto b = nearest_on_line(frame.origin, axis, view.ray(position));
    if (!a || !b || !(std::abs(*a) > 0)) return std::nullopt;
    factor = *b / *a;
  }
  if (state.ui.input.control()) factor = rounded_to(factor, kSnapFactor);
  factor = std::max(factor, kMinFactor);
  Vec3 scale(1);
  if (is_uniform)
    scale = Vec3(factor);
  else
    scale[drag_->handle.axis] = factor;
  Change change;
  // Along the axes of the object, about the origin of the handles.
  const Mat4 from_world = glm::inverse(frame.to_world);
  const Vec3 centre = Vec3(from_world * Vec4(frame.origin, 1));
  change.matrix = frame.to_world * glm::translate(Mat4(1), centre) * glm::scale(Mat4(1), scale) *
                  glm::translate(Mat4(1), -centre) * from_world;
  change.text = (is_uniform ? std::string("scale") : kAxisNames[static_cast<size_t>(drag_->handle.axis)]) +
                formatted(" \u00d7%.3g", static_cast<double>(factor));
  return change;
}

std::optional<Gizmo::Change> Gizmo::change_at(const AppState& state, Vec2 position) const {
  if (mode == GizmoMode::rotate) return rotation(state, position);
  return mode == GizmoMode::scale ? scaling(state, position) : movement(state, position);
}

std::vector<Gizmo::Moved> Gizmo::movable_nodes(const AppState& state) const {
  const scene::Scene& scene = *state.document().scene;
  const std::vector<Mat4>& world = state.viewport.node_places.of(state.document().scene).world;
  std::vector<Moved> list;
  for (const int index : selected_roots(state)) {
    const scene::Node& node = scene.nodes[static_cast<size_t>(index)];
    if (!is_movable(scene, index)) continue;
    Moved moved{.node = index, .to_world = world[static_cast<size_t>(index)]};
    if (node.parent >= 0) moved.parent = world[static_cast<size_t>(node.parent)];
    if (!scene::is_singular(moved.to_world) && !scene::is_singular(moved.parent)) list.push_back(moved);
  }
  return list;
}

std::optional<scene::Transform> Gizmo::changed_transform(const Moved& moved, const Change& change) const {
  scene::Transform transform = scene::posed_transform(*drag_->scene, moved.node);
  if (mode == GizmoMode::move) {
    // A matrix stays a matrix, so that the other values keep their bits.
    const Vec3 delta = glm::inverse(Mat3(moved.parent)) * change.translation;
    if (transform.matrix)
      (*transform.matrix)[3] += Vec4(delta, 0);
    else
      transform.translation += delta;
    return transform;
  }
  const bool mirrored = glm::determinant(Mat3(transform.to_matrix())) < 0;
  if (mirrored && mode == GizmoMode::scale) return std::nullopt;
  // Below a parent with a non-uniform scale, a rotation would shear the object.
  return scene::decompose({.matrix = glm::inverse(moved.parent) * change.matrix * moved.to_world});
}

void Gizmo::apply(AppState& state, const Change& change) {
  render::Document changed = state.document();
  auto scene = std::make_shared<scene::Scene>(*changed.scene);
  size_t count = 0;
  std::vector<std::pair<int, scene::Transform>> keyframes;
  for (const Moved& moved : drag_->moved)
    if (const auto transform = changed_transform(moved, change)) {
      if (scene::has_animated_transform(*scene, moved.node))
        keyframes.emplace_back(moved.node, *transform);
      else
        scene->nodes[static_cast<size_t>(moved.node)].transform = *transform;
      ++count;
    }
  if (count == 0) return;
  changed.scene = std::move(scene);
  for (const auto& [node, transform] : keyframes) {
    auto keyed = with_keyframe_at_present(changed, node, transform);
    if (!keyed) return state.notices.add_error(keyed.error().message);
    changed = std::move(*keyed);
  }
  const char* name = mode == GizmoMode::move ? "Move " : mode == GizmoMode::rotate ? "Rotate " : "Scale ";
  const int node = drag_->moved.front().node;
  const std::string& object = drag_->scene->nodes[static_cast<size_t>(node)].name;
  const std::string label = count > 1        ? std::to_string(count) + " objects"
                            : object.empty() ? "node " + std::to_string(node)
                                             : object;
  state.edit(std::move(changed), name + label, kGizmoGesture);
  readout_ = change.text;
}

void Gizmo::continue_drag(AppState& state) {
  const Input& input = state.ui.input;
  const bool is_stale = state.selection.node != drag_->node || !state.interface.visible;
  if (!input.buttons[0] || is_stale) {
    drag_.reset();
    state.editor->end_gesture();
    return;
  }
  if (input.mouse == last_position_) return;
  last_position_ = input.mouse;
  if (const auto change = change_at(state, input.mouse)) apply(state, *change);
}

void Gizmo::register_items(AppState& state, const Frame& frame) const {
  const GizmoView view(state.document(), state.viewport.image);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 point = mode == GizmoMode::rotate ? ring(frame.origin, frame.axes[axis], frame.length)[kRingSegments / 8]
                                                 : frame.origin + frame.axes[axis] * (0.8f * frame.length);
    if (const auto at = view.project(point))
      state.ui.items.add(std::string("gizmo.") + kAxisNames[static_cast<size_t>(axis)], Placement{*at - 1.0f, Vec2(2)});
  }
}

bool Gizmo::handle_input(AppState& state, bool hovered) {
  const Input& input = state.ui.input;
  if (drag_) {
    continue_drag(state);
    return true;
  }
  hovered_.reset();
  const auto frame = state.interface.visible ? frame_of(state) : std::nullopt;
  if (!frame) return false;
  register_items(state, *frame);
  if (!hovered) return false;
  hovered_ = handle_at(state, *frame, input.mouse);
  if (!hovered_ || !input.pressed[0]) return false;
  state.editor->end_gesture();
  drag_ = Drag{*hovered_, *frame, input.mouse, state.selection.node, movable_nodes(state), state.document().scene};
  last_position_ = input.mouse;
  readout_.clear();
  return true;
}

void Gizmo::draw(const AppState& state, ImDrawList& draw) const {
  const auto frame = frame_of(state);
  if (!frame) return;
  const GizmoPainter painter(GizmoView(state.document(), state.viewport.image), draw, state.ui.scale);
  const auto active = drag_ ? std::optional(drag_->handle) : hovered_;
  for (const GizmoHandle& handle : handles()) {
    const Vec3 axis = frame->axes[handle.axis];
    const ImU32 color = active == handle ? kActiveColor : color_of(handle);
    if (handle.kind == Kind::plane)
      painter.plane(plane_square(frame->origin, frame->axes, handle.axis, frame->length), color);
    else if (handle.kind == Kind::uniform)
      painter.centre(frame->origin, color);
    else if (mode == GizmoMode::rotate)
      painter.ring(ring(frame->origin, axis, frame->length), color);
    else
      painter.axis(frame->origin, frame->origin + axis * frame->length, mode == GizmoMode::scale, color);
  }
  if (drag_ && !readout_.empty()) draw_label(&draw, state.ui.input.mouse + Vec2(16, 16) * state.ui.scale, readout_);
}

void toggle_gizmo(AppState& state, GizmoMode mode) {
  Gizmo& gizmo = state.viewport.gizmo;
  gizmo.mode = gizmo.mode == mode ? GizmoMode::off : mode;
}

}  // namespace etendue::viewer
