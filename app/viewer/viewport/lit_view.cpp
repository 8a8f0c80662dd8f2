#include "viewer/viewport/lit_view.h"

#include <array>
#include <cmath>
#include <vector>

#include "base/hash.h"
#include "base/warp.h"
#include "camera/camera_ray.h"
#include "light/sampling/light_sample.h"
#include "render/document.h"
#include "scene/compiled_scene.h"
#include "scene/pose.h"
#include "viewer/tools/camera_controller.h"

namespace etendue::viewer {
namespace {

constexpr int kRayColumns = 24, kRayRows = 16;  // of camera rays
constexpr int kBounces = 4;

// A path from a surface point with diffuse reflections, and one light sample at each vertex.
class DiffusePath {
 public:
  DiffusePath(const scene::CompiledScene& scene, uint64_t seed) : scene_(scene), seed_(seed) {}

  // Whether light arrives along a ray that hits a surface.
  bool finds_light(Ray ray, Hit hit) {
    for (int bounce = 0; bounce <= kBounces; ++bounce) {
      const Vec3 wo = -ray.direction;
      scene::SurfacePoint point;
      scene_.surfaces({&wo, 1}, {&hit, 1}, &point);
      if (!is_black(scene_.emitted(point, wo)) || is_lit(point)) return true;
      const float first = random();
      const Vec2 u(first, random());
      point.spawn(Frame(facing(point)).to_world(square_to_cosine_hemisphere(u)), ray);
      hit = scene_.intersect(ray, 0);
      if (!hit) return !is_black(scene_.lights().environment().radiance(ray.direction));
    }
    return false;
  }

 private:
  // The normal on the side of the path.
  static Vec3 facing(const scene::SurfacePoint& point) { return point.front ? point.ng : -point.ng; }

  bool is_lit(const scene::SurfacePoint& point) {
    const LightTable& lights = scene_.lights();
    constexpr LightSampling kOne{LightStrategy::one};
    if (lights.empty(kOne)) return false;
    Vec3Lanes<kMaxLanes> from{};
    std::array<float, kMaxLanes> choice{}, u0{}, u1{};
    from.x[0] = point.position.x;
    from.y[0] = point.position.y;
    from.z[0] = point.position.z;
    choice[0] = random();
    u0[0] = random();
    u1[0] = random();
    std::array<LightSample, kMaxLanes> samples;
    lights.sample({.from = from, .choice = choice.data(), .u0 = u0.data(), .u1 = u1.data(), .count = 1}, samples.data(),
                  kOne);
    const LightSample& sample = samples[0];
    if (!(sample.pdf > 0) || is_black(sample.radiance) || !(glm::dot(sample.wi, facing(point)) > 0)) return false;
    if (sample.distance == 0) return true;
    Ray ray;
    point.spawn_segment(sample.wi, sample.distance, ray);
    return !scene_.intersect(ray, 0);
  }

  float random() { return to_unit_float(static_cast<uint32_t>(mix_bits(seed_ << 8 | used_++) >> 32)); }

  const scene::CompiledScene& scene_;
  const uint64_t seed_;
  uint64_t used_ = 0;
};

// A perspective camera at `eye` inside the scene.
Camera camera_inside(Camera camera, const Vec3& eye, const Vec3& target) {
  constexpr float kFieldOfView = 1.2f;
  const Camera view = look_at(eye, target, Vec3(0, 1, 0), kFieldOfView);
  camera.projection = Projection::perspective;
  camera.yfov = kFieldOfView;
  camera.to_world = view.to_world;
  return camera;
}

// Views of the whole scene from around it, and of its inside.
std::vector<Camera> views_of_scene(const Bounds& bounds, const Camera& camera, float aspect) {
  std::vector<Camera> views;
  const Vec3 centre = bounds.center();
  const Vec3 half = 0.5f * (bounds.max - bounds.min);
  const Vec3 sides[] = {{0.4f, 0.35f, 1}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 0, -1}, {0.01f, 1, 0.01f}};
  for (const Vec3& side : sides) {
    Camera view = camera;
    view.to_world = look_at(centre + glm::normalize(side), centre, Vec3(0, 1, 0), camera.yfov).to_world;
    views.push_back(CameraController().frame(view, bounds, aspect));
  }
  for (const float distance : {0.8f, 0.4f})
    for (const Vec3& side : {Vec3(0, 0.1f, 1), Vec3(1, 0.1f, 0), Vec3(0, 0.1f, -1), Vec3(-1, 0.1f, 0)})
      views.push_back(camera_inside(camera, centre + distance * half * side, centre - distance * half * side));
  return views;
}

}  // namespace

SeenSurfaces seen_surfaces(const scene::CompiledScene& scene, Camera camera, float aspect) {
  camera.lens_radius = 0;
  const Vec2i size(std::max(1, static_cast<int>(std::lround(256 * aspect))), 256);
  const CameraRays rays(camera, size.x, size.y);
  int all = 0, lit = 0;
  for (int row = 0; row < kRayRows; ++row)
    for (int column = 0; column < kRayColumns; ++column) {
      const Vec2 at((static_cast<float>(column) + 0.5f) / kRayColumns, (static_cast<float>(row) + 0.5f) / kRayRows);
      const Ray ray = rays.ray(at * Vec2(size), Vec2(0.5f));
      const Hit hit = scene.intersect(ray, 0);
      if (!hit) continue;
      ++all;
      lit += DiffusePath(scene, static_cast<uint64_t>(row * kRayColumns + column)).finds_light(ray, hit);
    }
  constexpr float kAll = kRayColumns * kRayRows;
  return {static_cast<float>(all) / kAll, static_cast<float>(lit) / kAll};
}

Camera lit_camera(const scene::CompiledScene& scene, const Camera& camera, float aspect) {
  SeenSurfaces seen = seen_surfaces(scene, camera, aspect);
  if (seen.suffice() || scene.bounds().empty()) return camera;
  Camera best = camera;
  for (const Camera& view : views_of_scene(scene.bounds(), camera, aspect)) {
    const SeenSurfaces candidate = seen_surfaces(scene, view, aspect);
    if (candidate.suffice()) return view;
    if (candidate.lit <= seen.lit) continue;
    best = view;
    seen = candidate;
  }
  return best;
}

Camera reset_camera(const render::Document& document, const scene::CompiledScene& scene) {
  const float aspect = static_cast<float>(document.width) / static_cast<float>(document.height);
  std::vector<Camera> cameras;
  if (document.origin) cameras.push_back(document.origin->camera);
  for (const Camera& camera : scene::placed_cameras(*document.scene)) cameras.push_back(camera);
  for (const Camera& camera : cameras)
    if (seen_surfaces(scene, camera, aspect).suffice()) return camera;
  return lit_camera(scene, scene::framing_camera(scene.bounds()), aspect);
}

}  // namespace etendue::viewer
