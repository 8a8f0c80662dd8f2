#include "trace/trace_names.h"

#include "light/placed_light.h"

namespace etendue::trace {
namespace {

std::string named(const std::string& name, const char* kind, size_t index) {
  return name.empty() ? kind + (" " + std::to_string(index)) : name;
}

}  // namespace

std::string node_name(const scene::CompiledScene& scene, uint32_t node) {
  return named(scene.description().nodes[node].name, "node", node);
}

std::string material_name(const scene::CompiledScene& scene, const scene::SurfacePoint& point) {
  if (point.in_volume) return "medium";
  const uint32_t index = point.instance->material;
  return named(scene.description().materials[index].name, "material", index);
}

std::string medium_name(const scene::CompiledScene& scene, const scene::Solid* solid) {
  if (solid) return node_name(scene, solid->node);
  return scene.solids().atmosphere() ? "atmosphere" : "vacuum";
}

std::string place_name(const scene::CompiledScene& scene, const scene::SurfacePoint& point) {
  return point.in_volume ? medium_name(scene, point.inside) : node_name(scene, point.instance->node);
}

std::string light_name(const scene::CompiledScene& scene, const LightSample& sample) {
  if (sample.kind == LightKind::environment) return "environment";
  if (sample.kind == LightKind::medium) return "media";
  if (sample.kind == LightKind::placed) {
    const size_t index = sample.light - scene.lights().triangles().size();
    return named(scene.lights().placed()[index].name, "light", index);
  }
  return node_name(scene, scene.instances()[scene.lights().triangles()[sample.light].instance].node);
}

std::vector<std::string> lobe_names(const transport::RecordedVertex& vertex) {
  std::vector<std::string> names;
  if (vertex.point.in_volume) names.push_back("volume");
  if (vertex.diffuse) names.push_back("diffuse");
  if (vertex.glossy) names.push_back("glossy");
  if (vertex.specular) names.push_back("specular");
  return names;
}

std::string scattering_name(const LobeSample<Rgb>& sample) {
  if (sample.type == ScatterType::volume) return "volume scattering";
  const char* type = sample.type == ScatterType::diffuse  ? "diffuse"
                     : sample.type == ScatterType::glossy ? "glossy"
                                                          : "specular";
  return std::string(type) + (sample.transmitted ? " transmission" : " reflection");
}

std::string end_reason(const transport::RecordedScattering& scattering) {
  switch (scattering.end) {
    case transport::PathEnd::none:
      return {};
    case transport::PathEnd::absorbed:
      return "absorbed";
    case transport::PathEnd::excluded:
      return "outside of the selected paths";
    case transport::PathEnd::roulette:
      break;
  }
  return scattering.roulette ? "ended by Russian roulette" : "below the contribution cutoff";
}

}  // namespace etendue::trace
