#include "scene/light_shapes.h"

#include "scene/builtin/shapes.h"

namespace etendue::scene {

bool is_hit_by_rays(const Light& light) {
  const auto surface = light.model->area_light(light.color);
  return surface && surface->hit_by_rays;
}

std::shared_ptr<const Mesh> mesh_of(const AreaLight& light) {
  if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&light.shape)) return *mesh;
  const auto& shape = std::get<AnalyticShape>(light.shape);
  const float r = shape.radius;
  if (shape.kind == AnalyticShape::Kind::sphere) return box(Vec3(r));
  if (shape.kind == AnalyticShape::Kind::cylinder) return box(Vec3(shape.half_length, r, r));
  return rectangle({-r, -r, 0}, {0, 2 * r, 0}, {2 * r, 0, 0});
}

std::shared_ptr<const AnalyticShape> analytic_shape_of(const AreaLight& light, const Mat4& to_world) {
  const auto* shape = std::get_if<AnalyticShape>(&light.shape);
  return shape ? std::make_shared<const AnalyticShape>(shape->placed(to_world)) : nullptr;
}

Material material_of(const Light& light) {
  const auto surface = light.model->area_light(light.color);
  Material m = diffuse(Rgb(0), surface && surface->hit_by_rays ? surface->radiance : Rgb(0));
  m.name = light.name;
  m.emission_spectrum = light.spectrum;
  m.double_sided = surface && surface->two_sided;
  return m;
}

std::shared_ptr<const Motion> without_scale(const Motion& motion) {
  auto copy = std::make_shared<Motion>(motion);
  for (Mat4& m : copy->to_world) m = without_scale(m);
  return copy;
}

}  // namespace etendue::scene
