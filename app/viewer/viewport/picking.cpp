#include "viewer/viewport/picking.h"

#include "camera/camera_ray.h"
#include "render/document.h"
#include "scene/compiled_scene.h"

namespace etendue::viewer {

std::optional<PickedSurface> pick(const render::Document& document, const scene::CompiledScene& scene,
                                  const Placement& image, Vec2 position) {
  if (!image.contains(position)) return std::nullopt;
  Camera pinhole = document.camera;
  pinhole.lens_radius = 0;
  const Vec2 raster = (position - image.corner) / image.size * Vec2(document.width, document.height);
  const Ray ray = CameraRays(pinhole, document.width, document.height).ray(raster, Vec2(0.5f));
  const Hit hit = scene.intersect(ray, 0);
  if (!hit) return std::nullopt;
  const auto& instance = scene.instances()[hit.instance];
  const Vec3 eye(pinhole.to_world[3]);
  const Vec3 back(pinhole.to_world[2]);
  const Vec3 hit_position = ray.origin + ray.direction * hit.t;
  return PickedSurface{.position = hit_position,
                       .axial_distance = glm::dot(eye - hit_position, back),
                       .node = static_cast<int>(instance.node),
                       .material = static_cast<int>(instance.material)};
}

Bounds bounds_of_node(const scene::CompiledScene& scene, int node) {
  Bounds bounds;
  for (const auto& instance : scene.instances())
    if (static_cast<int>(instance.node) == node) bounds.extend(bounds_of(*instance.mesh, instance.to_world));
  return bounds;
}

}  // namespace etendue::viewer
