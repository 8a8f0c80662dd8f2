// The surfaces that reflect or refract light specularly, and points on them where walks on a manifold start.
#pragma once
#include <vector>

#include "base/piecewise_constant.h"
#include "integrator/manifold/ray_derivatives.h"
#include "scene/compiled_scene.h"

namespace etendue::integrator::manifold {

// Whether the derivative of a surface's normal is known, so that manifold next event estimation can pass it: a triangle
// mesh that does not move, without stochastic opacity and without normal maps.
bool is_caster(const scene::InstanceData& instance, const SurfaceMaterial& material);

// The same for a point that a ray hits from the side of `wo`. Points whose shading normal was turned towards the viewer
// (CompiledScene) are left out, because their normal depends on the direction of the ray.
bool is_caster(const scene::SurfacePoint& point, const Vec3& wo);

// Whether all specular surfaces of a scene are casters.
bool has_only_casters(const scene::CompiledScene& scene);

// The triangle of a caster around a point on it.
CurvedSurface curved_surface(const scene::SurfacePoint& point);

// The casters of a scene, which must outlive them.
class SpecularCasters {
 public:
  explicit SpecularCasters(const scene::CompiledScene& scene);

  bool empty() const { return triangles_.empty(); }
  // A point, uniform over the area of all casters. The random numbers are uniform in [0, 1).
  Vec3 sample(float choice, Vec2 u) const;
  size_t memory() const { return triangles_.size() * (sizeof(Triangle) + sizeof(float) * 3); }  // bytes, about

 private:
  struct Triangle {
    uint32_t instance, triangle;
  };

  const scene::CompiledScene& scene_;
  std::vector<Triangle> triangles_;
  AliasTable by_area_;
};

}  // namespace etendue::integrator::manifold
