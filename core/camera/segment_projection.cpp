#include "camera/segment_projection.h"

#include <algorithm>

#include "camera/camera_ray.h"

namespace etendue {

std::optional<std::array<Vec2, 2>> project_segment(const Camera& camera, Vec2i image_size, const Vec3& from,
                                                   const Vec3& to) {
  Camera pinhole = camera;
  pinhole.lens_radius = pinhole.near_clip = 0;
  pinhole.far_clip = kInfinity;
  const CameraRays rays(pinhole, image_size.x, image_size.y);
  const auto depth = [&](const Vec3& p) { return glm::dot(Vec3(camera.to_world[3]) - p, Vec3(camera.to_world[2])); };
  // A small share of the length keeps the clipped end away from the singular plane of the lens.
  const float a = depth(from), b = depth(to), least = 1e-3f * std::max({1e-3f, std::abs(a), std::abs(b)});
  if (a < least && b < least) return std::nullopt;
  const Vec3 clipped = from + (to - from) * ((least - a) / (b - a));
  const auto first = rays.view(a < least ? clipped : from, Vec2(0.5f)),
             last = rays.view(b < least ? clipped : to, Vec2(0.5f));
  if (!first || !last) return std::nullopt;
  return std::array{first->raster, last->raster};
}

}  // namespace etendue
