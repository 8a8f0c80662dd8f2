#include "camera/camera_ray.h"

#include "camera/orthographic.h"
#include "camera/perspective.h"

namespace etendue {
namespace {

// Calls f with the projection; one line for each.
template <class F>
[[gnu::always_inline]] inline decltype(auto) with_projection(const Camera& camera, F&& f) {
  switch (camera.projection) {
    case Projection::orthographic:
      return f(OrthographicProjection());
    case Projection::perspective:
      break;
  }
  return f(PerspectiveProjection());
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, int width, int height, std::shared_ptr<const CameraMotion> motion)
    : camera_(camera), motion_(std::move(motion)) {
  if (motion_) camera_.to_world = Mat4(1);
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  const float half_height = with_projection(camera, [&](auto p) { return p.half_height(camera); });
  plane_.half_size = Vec2(half_height * aspect, half_height);
  plane_.raster_to_unit = Vec2(2 / static_cast<float>(width), 2 / static_cast<float>(height));
  parallel_ = with_projection(camera, [](auto p) { return p.kParallel; });
}

// A ray at the pose camera_.to_world.
template <class P>
[[gnu::always_inline]] inline Ray CameraRays::static_ray(Vec2 raster, Vec2 lens) const {
  Vec3 origin, direction;
  P::pinhole_ray(plane_.point(raster), origin, direction);
  if (camera_.lens_radius > 0) {
    const Vec3 focus = origin + direction * camera_.focus_distance;
    origin += Vec3(square_to_disk(lens) * camera_.lens_radius, 0);
    direction = focus - origin;
  }
  direction *= 1 / std::sqrt(length_squared(direction));
  // Clipping distances are measured along the optical axis.
  return {.origin = Vec3(camera_.to_world * Vec4(origin, 1)),
          .tnear = camera_.near_clip / -direction.z,
          .direction = Mat3(camera_.to_world) * direction,
          .tfar = camera_.far_clip / -direction.z};
}

void CameraRays::move(float time, Ray& ray) const {
  const Mat4 to_world = motion_->at(time);
  ray.origin = Vec3(to_world * Vec4(ray.origin, 1));
  ray.direction = Mat3(to_world) * ray.direction;
}

Ray CameraRays::ray(Vec2 raster, Vec2 lens, float time) const {
  Ray ray = with_projection(camera_, [&]<class P>(P) { return static_ray<P>(raster, lens); });
  if (motion_) move(time, ray);
  return ray;
}

void CameraRays::rays(const Pairs& raster, const Pairs& lens, const float* times, size_t count, Ray* rays) const {
  static_rays(raster, lens, count, rays);
  for (size_t i = 0; motion_ && i < count; ++i) move(times[i], rays[i]);
}

ETENDUE_VECTORIZE void CameraRays::static_rays(const Pairs& raster, const Pairs& lens, size_t count, Ray* rays) const {
  struct Lanes {
    Vec3Lanes<kMaxLanes> origin, direction;
    alignas(64) std::array<float, kMaxLanes> tnear, tfar;
  } lanes;
  for (size_t first = 0; first < count; first += kMaxLanes) {
    with_projection(camera_, [&]<class P>(P) {
      for (size_t i = 0; i < kMaxLanes; ++i) {
        const size_t k = first + i;
        const Ray ray = static_ray<P>({raster.x[k], raster.y[k]}, {lens.x[k], lens.y[k]});
        lanes.origin.set(i, ray.origin);
        lanes.direction.set(i, ray.direction);
        lanes.tnear[i] = ray.tnear;
        lanes.tfar[i] = ray.tfar;
      }
    });
    for (size_t i = 0; i < std::min(kMaxLanes, count - first); ++i)
      rays[first + i] = {lanes.origin[i], lanes.tnear[i], lanes.direction[i], lanes.tfar[i]};
  }
}

float CameraRays::pixels_per_area(const Vec3& direction, float distance, float time) const {
  const float c = cosine(direction, time);
  return with_projection(camera_, [&](auto p) { return p.pixels_per_area(plane_, c, distance); });
}

std::optional<CameraRays::View> CameraRays::view(const Vec3& point, Vec2 lens, float time) const {
  const Mat4 pose = to_world(time);
  const Mat3 rotation(pose);
  const Vec3 local = glm::transpose(rotation) * (point - Vec3(pose[3]));
  if (!(-local.z > camera_.near_clip) || -local.z > camera_.far_clip) return {};
  View view = with_projection(camera_, [&](auto p) { return p.view(plane_, camera_, local, lens_point(lens)); });
  view.wi = rotation * view.wi;
  return view;
}

std::optional<CameraRays::DirectionView> CameraRays::view_direction(const Vec3& direction, Vec2 lens,
                                                                    float time) const {
  const Mat4 pose = to_world(time);
  const Vec3 local = glm::transpose(Mat3(pose)) * direction;
  const float cosine = -local.z;
  if (!sees_environment() || !(cosine > 0)) return {};
  return with_projection(camera_, [&]<class P>(P) -> std::optional<DirectionView> {
    if constexpr (P::kParallel) {
      return {};
    } else {
      const Vec2 origin = lens_point(lens);
      DirectionView view;
      view.raster = P::raster_of(plane_, camera_, local, origin);
      view.ray.origin = Vec3(pose * Vec4(origin, 0, 1));
      view.ray.direction = direction;
      view.ray.tnear = camera_.near_clip / cosine;
      view.importance = P::pixels_per_solid_angle(plane_, cosine);
      return view;
    }
  });
}

std::optional<CameraRays::LensHit> CameraRays::intersect_lens(const Ray& ray, float length, float time) const {
  if (!can_be_hit()) return {};
  const Mat4 pose = to_world(time);
  const Mat3 to_camera = glm::transpose(Mat3(pose));
  const Vec3 origin = to_camera * (ray.origin - Vec3(pose[3])), direction = to_camera * ray.direction;
  if (!(direction.z > 0) || !(origin.z < 0) || -origin.z > camera_.far_clip) return {};
  const float distance = -origin.z / direction.z;
  const Vec3 point = origin + direction * distance;
  if (distance > length || sqr(point.x) + sqr(point.y) > sqr(camera_.lens_radius)) return {};
  return with_projection(camera_, [&]<class P>(P) -> std::optional<LensHit> {
    if constexpr (P::kParallel) {
      return {};
    } else {
      const float density = P::pixels_per_solid_angle(plane_, direction.z);
      return LensHit{.raster = P::raster_of(plane_, camera_, -direction, Vec2(point)),
                     .distance = distance,
                     .importance = density / (lens_area() * direction.z),
                     .cosine = direction.z,
                     .density = density};
    }
  });
}

}  // namespace etendue
