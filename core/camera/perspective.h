// Perspective projection                                                                     [Lang, sec. 8.4.3.2]
//
// Camera rays go from the lens point l to the point f p of the plane in focus, where p = (x, y, -1) is a point of the
// image plane and f the focus distance. A direction d seen from l therefore has the image point d / |d.z| + l / f.
//
// Solid angle and area of the image plane are related by dw = cos^3(theta) dA, with the angle theta to the optical
// axis.
#pragma once
#include "camera/projection.h"

namespace etendue {

struct PerspectiveProjection {
  static constexpr bool kParallel = false;

  static float half_height(const Camera& camera) { return std::tan(0.5f * camera.yfov); }

  // The ray of a pinhole camera through a point of the image plane; the direction is not normalised.
  static void pinhole_ray(Vec2 image_point, Vec3& origin, Vec3& direction) {
    origin = Vec3(0);
    direction = Vec3(image_point, -1);
  }

  static float pixels_per_solid_angle(const ImagePlane& plane, float cosine) {
    return 1 / (plane.pixel_area() * cosine * sqr(cosine));
  }

  // The density of camera rays in pixels per square metre perpendicular to them, at a distance from the lens; `cosine`
  // is that of the angle to the optical axis.
  static float pixels_per_area(const ImagePlane& plane, float cosine, float distance) {
    return pixels_per_solid_angle(plane, cosine) / sqr(distance);
  }

  // The raster position of a direction as seen from a lens point. Inlined, because returning a Vec2 in a register
  // causes store-forwarding stalls.
  [[gnu::always_inline]] static Vec2 raster_of(const ImagePlane& plane, const Camera& camera, const Vec3& direction,
                                               Vec2 lens_point) {
    const float scale = -1 / direction.z;
    const Vec2 slope(direction.x * scale, direction.y * scale);
    return plane.raster(camera.lens_radius > 0 ? lens_point / camera.focus_distance + slope : slope);
  }

  // The view of a point in camera space with z < 0.
  static CameraView view(const ImagePlane& plane, const Camera& camera, const Vec3& point, Vec2 lens_point) {
    const Vec3 to_lens = Vec3(lens_point, 0) - point;
    const float distance = std::sqrt(length_squared(to_lens)), cosine = -point.z / distance;
    return {.raster = raster_of(plane, camera, -to_lens, lens_point),
            .wi = to_lens / distance,
            .distance = distance - camera.near_clip / cosine,
            .importance = pixels_per_area(plane, cosine, distance)};
  }
};

}  // namespace etendue
