#include "radiosity/reflectance.h"

#include "scene/texture_point.h"

namespace etendue::radiosity {
namespace {

// A texture is sampled at the centroids of kSteps^2 parts of the patch.
constexpr uint32_t kSteps = 4;

Rgb mean_reflectance(const scene::InstanceData& instance, const SurfaceMaterial& material, const PatchMesh& mesh,
                     uint32_t patch) {
  const auto at = [&](Vec2 barycentric) {
    TexturePoint point;
    if (instance.textured) {
      const Vec2 b = mesh.in_triangle(patch, barycentric);
      point = scene::texture_point(*instance.mesh, mesh.patches()[patch].triangle, b.x, b.y);
    }
    const Vec4 base = material.base_color_at(point);
    return Rgb(base.x, base.y, base.z);
  };
  if (!instance.textured) return at(Vec2(1.0f / 3));
  Rgb sum(0);
  for (uint32_t i = 0; i < kSteps; ++i)
    for (uint32_t j = 0; i + j < kSteps; ++j) {
      const Vec2 corner(static_cast<float>(i), static_cast<float>(j));
      sum += at((corner + 1.0f / 3) / static_cast<float>(kSteps));
      if (i + j + 1 < kSteps) sum += at((corner + 2.0f / 3) / static_cast<float>(kSteps));
    }
  return sum / sqr(static_cast<float>(kSteps));
}

}  // namespace

std::vector<Rgb> patch_reflectances(const scene::CompiledScene& scene, const PatchMesh& mesh) {
  std::vector<Rgb> list;
  list.reserve(mesh.patches().size());
  for (uint32_t p = 0; p < mesh.patches().size(); ++p) {
    const scene::InstanceData& instance = scene.instances()[mesh.patches()[p].instance];
    list.push_back(mean_reflectance(instance, scene.materials()[instance.material], mesh, p));
  }
  return list;
}

std::string non_diffuse_material(const scene::CompiledScene& scene) {
  for (const auto& instance : scene.instances()) {
    const SurfaceMaterial& material = scene.materials()[instance.material];
    if (material.is_lambertian) continue;
    const std::string& name = material.description.name;
    return name.empty() ? "material " + std::to_string(instance.material) : "material '" + name + "'";
  }
  return {};
}

}  // namespace etendue::radiosity
