// Camera movements: orbit, pan, dolly, fly, and framing of objects.
#pragma once
#include "base/vec.h"
#include "scene/forward.h"

namespace etendue {
struct Bounds;
struct Camera;
}  // namespace etendue

namespace etendue::viewer {

// All movements return the moved camera. Mouse movements are in pixels.
class CameraController {
 public:
  // The centre of orbits.
  const Vec3& pivot() const { return pivot_; }
  void set_pivot(const Vec3& pivot) { pivot_ = pivot; }
  // Sets the pivot to the point where the camera axis hits the scene; without a hit, to a point on the axis near the
  // centre of the scene. Also sets the fly speed according to the size of the scene.
  void reset_pivot(const Camera& camera, const scene::CompiledScene& scene);

  Camera orbit(Camera camera, Vec2 movement) const;
  // `image_height` in pixels.
  Camera pan(Camera camera, Vec2 movement, float image_height);
  // Moves towards `target` by this many notches of the wheel.
  Camera dolly(Camera camera, const Vec3& target, float notches) const;
  Camera look_around(Camera camera, Vec2 movement) const;
  // `direction` is in camera coordinates: x right, y up, z backward.
  Camera fly(Camera camera, const Vec3& direction, float seconds) const;
  float fly_speed() const { return fly_speed_; }
  void set_fly_speed(float metres_per_second) { fly_speed_ = metres_per_second; }

  // Moves the camera along its axis so that it shows all of `bounds`, whose centre becomes the pivot. `aspect` is width
  // divided by height.
  Camera frame(Camera camera, const Bounds& bounds, float aspect);

 private:
  Vec3 pivot_{0};
  float fly_speed_ = 1;
};

}  // namespace etendue::viewer
