// The list of sections, and the sections of integrators and samplers.
#include "render/document_parameters.h"

#include <algorithm>
#include <charconv>

#include "integrator/integrator.h"

namespace etendue::render {
namespace {

// The parameters of an integrator or a sampler, with the values that the document gives them.
DocumentParameters method_parameters(const Document& document, const std::string& owner,
                                     const std::vector<ParameterInfo>& infos) {
  DocumentParameters list;
  for (const ParameterInfo& info : infos) {
    DocumentParameter parameter;
    parameter.section = owner;
    parameter.info = info;
    parameter.info.name = owner + "." + info.name;
    for (const auto& [name, value] : document.method.settings)
      if (name == parameter.info.name) parameter.info.default_value = value;
    parameter.assign = [name = parameter.info.name, default_value = info.default_value](Document& d, const Value& v) {
      auto& settings = d.method.settings;
      std::erase_if(settings, [&](const auto& setting) { return setting.first == name; });
      if (v != default_value) settings.emplace_back(name, v);
      std::ranges::sort(settings, {}, [](const auto& setting) { return setting.first; });
    };
    list.push_back(std::move(parameter));
  }
  return list;
}

}  // namespace

std::optional<size_t> section_index(std::string_view section, std::string_view kind, size_t count) {
  if (!section.starts_with(kind) || section.size() <= kind.size() || section[kind.size()] != '.') return {};
  const std::string_view digits = section.substr(kind.size() + 1);
  size_t index = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  if (error != std::errc{} || end != digits.data() + digits.size() || index >= count) return {};
  return index;
}

std::vector<std::string> sections(const Document& document) {
  std::vector<std::string> list{"render", "auto",        "film",       "camera", "display",
                                "scene",  "environment", "atmosphere", "model"};
  for (const auto& info : integrator::integrator_infos()) list.push_back(info.name);
  for (const auto& info : sampler_infos()) list.push_back(info.name);
  const scene::Scene& scene = *document.scene;
  for (size_t i = 0; i < scene.materials.size(); ++i) list.push_back("material." + std::to_string(i));
  for (size_t i = 0; i < scene.lights.size(); ++i) list.push_back("light." + std::to_string(i));
  for (size_t i = 0; i < scene.nodes.size(); ++i) list.push_back("node." + std::to_string(i));
  return list;
}

std::vector<DocumentParameter> section_parameters(const Document& document, std::string_view section) {
  if (section == "render") return render_parameters(document);
  if (section == "auto") return automatic_parameters(document);
  if (section == "film") return film_parameters(document);
  if (section == "display") return display_parameters(document);
  if (section == "scene") return scene_parameters(document);
  if (section == "model") return model_parameters(document);
  if (section == "camera") return camera_parameters(document);
  if (section == "environment") return environment_parameters(document);
  if (section == "atmosphere") return atmosphere_parameters(document);
  if (const auto* info = integrator::find_integrator(section))
    return method_parameters(document, info->name, info->parameters);
  if (const auto* info = find_sampler(section)) return method_parameters(document, info->name, info->parameters);
  const std::string name(section);
  const scene::Scene& scene = *document.scene;
  if (const auto i = section_index(section, "material", scene.materials.size()))
    return material_parameters(document, *i, name);
  if (const auto i = section_index(section, "light", scene.lights.size())) return light_parameters(document, *i, name);
  if (const auto i = section_index(section, "node", scene.nodes.size())) return node_parameters(document, *i, name);
  return {};
}

}  // namespace etendue::render
