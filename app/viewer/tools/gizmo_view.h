// Positions in the window, and rays through them.
#pragma once
#include <optional>

#include "geometry/ray.h"
#include "viewer/viewport/placement.h"

namespace etendue::render {
struct Document;
}

namespace etendue::viewer {

// Relates points of the scene to positions in the window, for a document and the rectangle of its image.
class GizmoView {
 public:
  GizmoView(const render::Document& document, const Placement& image) : document_(document), image_(image) {}

  // The position of a point; nothing if it is behind the camera.
  std::optional<Vec2> project(const Vec3& point) const;
  // The ray of a pinhole camera through a position.
  Ray ray(Vec2 position) const;
  // The size of a window pixel at a point, in metres.
  float pixel_size(const Vec3& point) const;
  // From the point towards the camera, normalised.
  Vec3 towards_camera(const Vec3& point) const;

 private:
  const render::Document& document_;
  Placement image_;
};

// The parameter of the point of a line that is nearest to the ray; nothing if they are parallel.
std::optional<float> nearest_on_line(const Vec3& origin, const Vec3& direction, const Ray& ray);
// Where the ray meets a plane; nothing if it is parallel or the plane is behind its origin.
std::optional<Vec3> meet_plane(const Vec3& origin, const Vec3& normal, const Ray& ray);
// The distance of a point from a segment of the window.
float distance_to_segment(Vec2 point, Vec2 from, Vec2 to);

}  // namespace etendue::viewer
