// What all projections share: the image plane and the view of a point
//
// A projection is a struct like those in perspective.h and orthographic.h, with static functions in camera space: the
// lens is at the origin, the camera looks along -z, +y is up. To add one, write such a file, add an enumerator to
// Projection (camera.h), and add a line to `with_projection` in camera_ray.cpp.
#pragma once
#include "camera/camera.h"

namespace etendue {

// The mapping between raster coordinates (pixels from the upper left corner) and the image plane. The image plane is
// centred on the optical axis, in metres: at distance 1 in a perspective, at the lens in a parallel projection.
struct ImagePlane {
  Vec2 half_size;
  Vec2 raster_to_unit;  // 2 / resolution

  Vec2 point(Vec2 raster) const {
    const Vec2 unit = raster * raster_to_unit - 1.0f;
    return {unit.x * half_size.x, -unit.y * half_size.y};
  }
  Vec2 raster(Vec2 point) const { return (Vec2(point.x, -point.y) / half_size + 1.0f) / raster_to_unit; }
  // In square metres.
  float pixel_area() const { return raster_to_unit.x * raster_to_unit.y * half_size.x * half_size.y; }
};

// A point of the scene as seen through a point of the lens: the inverse of a camera ray.
struct CameraView {
  Vec2 raster;       // may be outside of the image
  Vec3 wi;           // unit direction from the point to the lens
  float distance;    // from the point to where the camera ray starts: the near plane, or the lens
  float importance;  // pixels per square metre perpendicular to wi, at the point
};

}  // namespace etendue
