// Orthographic (parallel) projection
//
// Camera rays of a pinhole start at the image plane, which is at z = 0, and go along -z. With a lens, the ray of an
// image point p through the lens point l starts at p + l and meets the optical ray of p in the plane in focus: through
// each lens point, the scene is seen in a single direction.
#pragma once
#include "camera/projection.h"

namespace etendue {

struct OrthographicProjection {
  static constexpr bool kParallel = true;

  static float half_height(const Camera& camera) { return camera.ymag; }

  // The ray of a pinhole camera through a point of the image plane.
  static void pinhole_ray(Vec2 image_point, Vec3& origin, Vec3& direction) {
    origin = Vec3(image_point, 0);
    direction = Vec3(0, 0, -1);
  }

  // The density of camera rays in pixels per square metre perpendicular to them, which does not depend on the distance;
  // `cosine` is that of the angle to the optical axis.
  static float pixels_per_area(const ImagePlane& plane, float cosine, float) {
    return 1 / (plane.pixel_area() * cosine);
  }

  // The view of a point in camera space with z < 0.
  static CameraView view(const ImagePlane& plane, const Camera& camera, const Vec3& point, Vec2 lens_point) {
    const float depth = -point.z;
    const Vec3 slope(-lens_point / camera.focus_distance, -1);
    const float length = std::sqrt(length_squared(slope)), cosine = 1 / length;
    return {.raster = plane.raster(Vec2(point) - Vec2(slope) * depth - lens_point),
            .wi = slope * -cosine,
            .distance = (depth - camera.near_clip) * length,
            .importance = pixels_per_area(plane, cosine, depth)};
  }
};

}  // namespace etendue
