#include "integrator/manifold/specular_casters.h"

#include <algorithm>

#include "scene/facet.h"

namespace etendue::integrator::manifold {

bool is_caster(const scene::InstanceData& instance, const SurfaceMaterial& material) {
  return material.has_delta_lobes && !material.has_normal_map && !material.has_alpha && !instance.round &&
         !instance.motion;
}

bool is_caster(const scene::SurfacePoint& point, const Vec3& wo) {
  constexpr float kMinCosine = 2e-3f;  // twice that to which shading normals are turned
  return is_caster(*point.instance, *point.material) && std::abs(glm::dot(point.shading.z, wo)) > kMinCosine;
}

bool has_only_casters(const scene::CompiledScene& scene) {
  return std::ranges::all_of(scene.instances(), [&](const scene::InstanceData& instance) {
    const SurfaceMaterial& material = scene.materials()[instance.material];
    return !material.has_delta_lobes || is_caster(instance, material);
  });
}

CurvedSurface curved_surface(const scene::SurfacePoint& point) {
  const scene::InstanceData& instance = *point.instance;
  const Facet f = scene::facet_of(instance, point.triangle, 0);
  CurvedSurface surface{point.ng, point.shading.z, f.p1 - f.p0, f.p2 - f.p0, Vec3(0), Vec3(0)};
  if (!instance.smooth) return surface;
  const Triangle& t = instance.mesh->triangles[point.triangle];
  const auto normal = [&](size_t corner) { return instance.normal_to_world * instance.mesh->normals[t[corner]]; };
  const Vec3 n0 = normal(0), du = normal(1) - n0, dv = normal(2) - n0;
  const Vec2 uv = surface.coordinates(point.position - f.p0);
  const Vec3 interpolated = n0 + du * uv.x + dv * uv.y;
  const float length = glm::length(interpolated);
  if (!(length > 0)) return surface;
  const Vec3& n = surface.normal;
  const float scale = (glm::dot(interpolated, n) < 0 ? -1.0f : 1.0f) / length;
  surface.dn_du = (du - n * glm::dot(n, du)) * scale;
  surface.dn_dv = (dv - n * glm::dot(n, dv)) * scale;
  return surface;
}

SpecularCasters::SpecularCasters(const scene::CompiledScene& scene) : scene_(scene) {
  std::vector<float> areas;
  for (size_t i = 0; i < scene.instances().size(); ++i) {
    const scene::InstanceData& instance = scene.instances()[i];
    if (!is_caster(instance, scene.materials()[instance.material])) continue;
    for (uint32_t t = 0; t < instance.mesh->triangles.size(); ++t) {
      const Facet f = scene::facet_of(instance, t, 0);
      triangles_.push_back({static_cast<uint32_t>(i), t});
      areas.push_back(0.5f * glm::length(glm::cross(f.p1 - f.p0, f.p2 - f.p0)));
    }
  }
  if (!triangles_.empty()) by_area_ = AliasTable(areas);
}

Vec3 SpecularCasters::sample(float choice, Vec2 u) const {
  const Triangle& chosen = triangles_[by_area_.sample(choice).index];
  const Facet f = scene::facet_of(scene_.instances()[chosen.instance], chosen.triangle, 0);
  if (u.x + u.y > 1) u = Vec2(1) - u;
  return f.p0 + (f.p1 - f.p0) * u.x + (f.p2 - f.p0) * u.y;
}

}  // namespace etendue::integrator::manifold
