// The hand on the camera: orbit, pan, dolly, fly, and which ray a pixel of the viewport stands for.
#pragma once
#include <optional>

#include "geometry/mesh.h"
#include "render/document.h"
#include "scene/forward.h"
#include "viewer/viewport/image_view.h"

namespace etendue::viewer {

// What a pixel of the picture shows.
struct Picked {
  Vec3 position{0};
  float axial_distance = 0;  // along the camera's axis, as focus is measured
  int node = -1, material = -1;
};

// Nothing where the ray meets nothing, or outside the picture.
std::optional<Picked> pick(const render::Document& document, const scene::CompiledScene& scene,
                           const Placement& picture, Vec2 at);

// All moves return the camera that the move leads to; `amount` is in pixels of a picture that is `height` pixels high.
class CameraHand {
 public:
  const Vec3& pivot() const { return pivot_; }
  void set_pivot(const Vec3& pivot) { pivot_ = pivot; }
  // Puts the pivot where the axis meets the scene, or in front of the camera at the distance of what there is.
  void find_pivot(const Camera& camera, const scene::CompiledScene& scene);

  Camera orbit(Camera camera, Vec2 amount) const;
  Camera pan(Camera camera, Vec2 amount, float height);
  // Towards `target` by this many notches of a wheel.
  Camera dolly(Camera camera, const Vec3& target, float notches) const;
  Camera look_around(Camera camera, Vec2 amount) const;
  // `direction` is in the camera's frame: x right, y up, z back.
  Camera fly(Camera camera, const Vec3& direction, float seconds) const;
  void set_speed(float metres_per_second) { speed_ = metres_per_second; }
  float speed() const { return speed_; }

  // Keeps the direction and shows all of `bounds`.
  Camera frame(Camera camera, const Bounds& bounds, float aspect);

 private:
  Vec3 pivot_{0};
  float speed_ = 1;
};

// What a node shows, in the world.
Bounds bounds_of_node(const scene::CompiledScene& scene, int node);
// Where a point of the world is seen; nothing behind the camera.
std::optional<Vec2> project(const Camera& camera, const Placement& picture, const Vec3& point);

}  // namespace etendue::viewer
