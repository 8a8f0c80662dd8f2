#include "scene/light_counts.h"

#include <set>

#include "base/number_text.h"
#include "light/placed_light.h"
#include "scene/compiled_scene.h"

namespace etendue::scene {
namespace {

bool is_light(const Scene& scene, uint32_t node) { return scene.nodes[node].light >= 0; }

bool is_hidden(const Scene& scene, size_t node) {
  for (int i = static_cast<int>(node); i >= 0; i = scene.nodes[static_cast<size_t>(i)].parent)
    if (!scene.nodes[static_cast<size_t>(i)].visible) return true;
  return false;
}

}  // namespace

LightCounts count_lights(const CompiledScene& scene) {
  LightCounts counts;
  const Scene& description = scene.description();
  std::set<uint32_t> emissive;
  for (const AreaLightTriangle& triangle : scene.lights().triangles()) {
    const uint32_t node = scene.instances()[triangle.instance].node;
    if (is_light(description, node)) continue;
    emissive.insert(node);
    if (!triangle.is_analytic()) ++counts.emissive_triangles;
  }
  counts.emissive_objects = emissive.size();
  for (size_t node = 0; node < description.nodes.size(); ++node)
    if (is_light(description, static_cast<uint32_t>(node)) && !is_hidden(description, node)) ++counts.lights;
  counts.environment = !description.environment.black();
  return counts;
}

std::string light_text(const LightCounts& counts) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (counts.lights > 0) add(format_count(counts.lights, "light", "lights"));
  if (counts.emissive_objects > 0)
    add(format_count(counts.emissive_objects, "emissive object", "emissive objects") + " (" +
        format_count(counts.emissive_triangles, "triangle", "triangles") + ")");
  if (counts.environment) add("environment");
  return text.empty() ? "none" : text;
}

}  // namespace etendue::scene
