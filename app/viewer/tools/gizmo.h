// Handles in the viewport that move, rotate and scale the selected objects.
//
// The handles are at the centre of the bounds of the active object's mesh; all selected objects move with it, and rotate
// and scale about that point.
// All movements are computed from the transform at the start of the drag, so rounding errors do not accumulate. A drag is
// one step of undo.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "scene/scene.h"
#include "viewer/tools/mesh_centre.h"

struct ImDrawList;

namespace etendue::viewer {

struct AppState;

enum class GizmoMode : uint8_t { off, move, rotate, scale };

// What a drag changes: along or about one axis, in the plane perpendicular to an axis, or all axes alike.
struct GizmoHandle {
  enum class Kind : uint8_t { axis, plane, uniform };
  Kind kind = Kind::axis;
  int axis = 0;

  friend bool operator==(const GizmoHandle&, const GizmoHandle&) = default;
};

class Gizmo {
 public:
  GizmoMode mode = GizmoMode::off;
  bool local = false;  // axes of the object rather than of the world

  // Called once per frame; `hovered` is whether the pointer is over the viewport. Returns whether the gizmo uses the
  // pointer.
  bool handle_input(AppState& state, bool hovered);
  void draw(const AppState& state, ImDrawList& draw) const;
  bool is_dragging() const { return drag_.has_value(); }

 private:
  // Where the handles are, for the selected object.
  struct Frame {
    Vec3 origin{0};    // centre of the bounds of the mesh, or origin of a node without a mesh
    Mat3 axes{1};      // columns, normalised
    float length = 1;  // of an axis, metres; constant on screen
    Mat4 to_world{1};  // of the node
    Mat4 parent{1};    // from the parent's space to the world
  };
  // A node that the drag changes, at the start of the drag.
  struct Moved {
    int node = -1;
    Mat4 to_world{1};
    Mat4 parent{1};  // from the parent's space to the world
  };
  struct Drag {
    GizmoHandle handle;
    Frame frame;
    Vec2 start{0};  // position of the pointer
    int node = -1;
    std::vector<Moved> moved;
    std::shared_ptr<const scene::Scene> scene;  // at the start of the drag
  };
  // A change of the object in world space, and its description.
  struct Change {
    Mat4 matrix{1};
    Vec3 translation{0};
    std::string text;
  };

  std::optional<Frame> frame_of(const AppState& state) const;
  std::vector<GizmoHandle> handles() const;
  std::optional<GizmoHandle> handle_at(const AppState& state, const Frame& frame, Vec2 position) const;
  std::optional<Change> change_at(const AppState& state, Vec2 position) const;
  std::optional<Change> movement(const AppState& state, Vec2 position) const;
  std::optional<Change> rotation(const AppState& state, Vec2 position) const;
  std::optional<Change> scaling(const AppState& state, Vec2 position) const;
  // The selected nodes that can be moved.
  std::vector<Moved> movable_nodes(const AppState& state) const;
  // The transform of a node after the change; nothing if the mode cannot produce it.
  std::optional<scene::Transform> changed_transform(const Moved& moved, const Change& change) const;
  void apply(AppState& state, const Change& change);
  void continue_drag(AppState& state);
  // Names a point of each axis or ring for scripts.
  void register_items(AppState& state, const Frame& frame) const;

  MeshCentre mesh_centre_;
  std::optional<Drag> drag_;
  std::optional<GizmoHandle> hovered_;
  Vec2 last_position_{0};  // of the pointer
  std::string readout_;    // of the drag
};

// Activates a mode, or none if it is active.
void toggle_gizmo(AppState& state, GizmoMode mode);

}  // namespace etendue::viewer
