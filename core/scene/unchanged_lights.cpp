#include "scene/unchanged_lights.h"

#include <algorithm>

#include "scene/pose.h"

namespace etendue::scene {
namespace {

// Whether each node is part of the scene and visible. Descendants of hidden nodes are not.
std::vector<bool> visible_nodes(const Scene& scene) {
  std::vector<bool> marks(scene.nodes.size());
  std::vector<int> open = scene.roots;
  while (!open.empty()) {
    const auto node = static_cast<size_t>(open.back());
    open.pop_back();
    if (!scene.nodes[node].visible) continue;
    marks[node] = true;
    open.insert(open.end(), scene.nodes[node].children.begin(), scene.nodes[node].children.end());
  }
  return marks;
}

}  // namespace

bool same_emission(const Scene& a, const Scene& b) {
  return std::ranges::equal(a.materials, b.materials, [](const Material& x, const Material& y) {
    return x.emission == y.emission && x.emission_texture == y.emission_texture &&
           x.emission_spectrum == y.emission_spectrum && x.unlit == y.unlit && x.double_sided == y.double_sided;
  });
}

bool same_surface(const InstanceData& a, const InstanceData& b) {
  if (a.motion || b.motion || a.material != b.material || a.cosine_exponent != b.cosine_exponent) return false;
  if (a.to_world != b.to_world) return false;
  return a.mesh == b.mesh || (a.mesh->positions == b.mesh->positions && same_parametrization(*a.mesh, *b.mesh));
}

bool same_emitters(const InstanceArray& now, const InstanceArray& old, const std::vector<SurfaceMaterial>& materials) {
  return std::ranges::equal(now, old, [&](const InstanceData& a, const InstanceData& b) {
    const bool emitted = b.first_light != InstanceData::kNotALight;
    return is_area_light(materials[a.material]) == emitted && (!emitted || same_surface(a, b));
  });
}

bool same_light_places(const Scene& a, const Scene& b) {
  if (!a.animations.empty() || a.roots != b.roots ||
      !std::ranges::equal(a.nodes, b.nodes, {}, &Node::children, &Node::children))
    return false;
  if (a.lights.empty() && b.lights.empty()) return true;
  if (visible_nodes(a) != visible_nodes(b)) return false;
  const std::vector<Mat4> place_a = world_matrices(a), place_b = world_matrices(b);
  for (size_t i = 0; i < a.nodes.size(); ++i) {
    if (a.nodes[i].light != b.nodes[i].light) return false;
    if (a.nodes[i].light >= 0 && place_a[i] != place_b[i]) return false;
  }
  return true;
}

bool same_parametrization(const Mesh& a, const Mesh& b) {
  return &a == &b || (a.triangles == b.triangles && a.uvs == b.uvs && a.colors == b.colors);
}

bool is_area_light(const SurfaceMaterial& material) {
  return material.description.is_emissive() && !material.description.unlit;
}

}  // namespace etendue::scene
