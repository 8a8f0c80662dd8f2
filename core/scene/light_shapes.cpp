#include "scene/light_shapes.h"

#include "scene/builtin/shapes.h"

namespace etendue::scene {

std::shared_ptr<const Mesh> stand_in(const Light& light) {
  const bool quad = light.type == LightType::quad;
  const Vec3 half(quad ? 0.5f * light.width : light.radius, quad ? 0.5f * light.height : light.radius, light.radius);
  if (light.type == LightType::sphere) return box(half);
  return rectangle({-half.x, -half.y, 0}, {0, 2 * half.y, 0}, {2 * half.x, 0, 0});
}

AnalyticShape shape_of(const Light& light) {
  AnalyticShape shape;
  shape.kind = light.type == LightType::disk ? AnalyticShape::Kind::disk : AnalyticShape::Kind::sphere;
  shape.radius = light.radius;
  return shape;
}

Material material_of(const Light& light) {
  Material m = diffuse(Rgb(0), is_met_by_rays(light) ? light.radiance() : Rgb(0));
  m.name = light.name;
  m.double_sided = light.sides() == 2;
  return m;
}

std::shared_ptr<const Motion> without_scale(const Motion& motion) {
  auto copy = std::make_shared<Motion>(motion);
  for (Mat4& m : copy->to_world) m = without_scale(m);
  return copy;
}

}  // namespace etendue::scene
