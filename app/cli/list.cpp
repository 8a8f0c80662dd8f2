// etendue list: the registries, with every parameter described.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "integrator/integrator.h"
#include "render/document.h"
#include "sampling/sampler.h"
#include "scene/builtin/builtin.h"
#include "viewer/viewer.h"

namespace etendue::cli {
namespace {

using nlohmann::json;

json value_json(const Value& value) {
  return std::visit([](const auto& v) { return json(v); }, value);
}

json parameter_json(const ParameterInfo& p) {
  json j{{"name", p.name},
         {"label", p.label},
         {"type", type_name(p.type)},
         {"unit", p.unit},
         {"min", nullptr},
         {"max", nullptr},
         {"default", value_json(p.default_value)},
         {"doc", p.doc}};
  if (p.type == ParameterType::integer || p.type == ParameterType::number) j["min"] = p.min, j["max"] = p.max;
  if (p.type == ParameterType::choice) j["options"] = p.options;
  return j;
}

json entry(const std::string& name, const std::string& label, const std::string& doc,
           const std::vector<ParameterInfo>& parameters) {
  json list = json::array();
  for (const auto& p : parameters) list.push_back(parameter_json(p));
  return {{"name", name}, {"label", label}, {"doc", doc}, {"parameters", list}};
}

json integrators() {
  json list = json::array();
  for (const auto& info : integrator::integrator_infos()) {
    json j = entry(info.name, info.label, info.summary, info.parameters);
    j["group"] = integrator::info_of(info.group).name,
    j["key"] = info.shortcut ? json(std::string(1, info.shortcut)) : json();
    j["paths"] = info.paths, j["point_paths"] = info.point_paths, j["bias"] = integrator::bias_name(info.bias),
    j["cost"] = info.cost, j["fails"] = info.limitations;
    list.push_back(j);
  }
  return list;
}

json samplers() {
  json list = json::array();
  for (const auto& info : sampler_infos()) list.push_back(entry(info.name, info.label, info.doc, info.parameters));
  return list;
}

// A section's parameters as a scene with just that object has them, names without the section.
std::vector<ParameterInfo> bare(const std::vector<render::DocumentParameter>& bindings) {
  std::vector<ParameterInfo> infos;
  for (const auto& b : bindings) {
    infos.push_back(b.info);
    infos.back().name = b.info.name.substr(b.section.size() + 1);
  }
  return infos;
}

render::Document with_one_light(LightType type) {
  render::Document d;
  auto scene = std::make_shared<scene::Scene>();
  scene->materials.emplace_back();
  scene->lights.emplace_back();
  scene->lights[0].type = type;
  d.scene = scene;
  return d;
}

json presets(const std::vector<ModelPreset>& presets) {
  json list = json::array();
  for (const auto& p : presets) {
    json values = json::object();
    for (const auto& [name, value] : p.values) values[name] = value_json(value);
    list.push_back({{"name", p.name}, {"label", p.label}, {"source", p.source}, {"values", values}});
  }
  return list;
}

json materials() {
  const auto d = with_one_light(LightType::point);
  json list = json::array({entry(
      "gltf", "glTF surface",
      "Metallic-roughness with transmission, volume, specular, ior and emission, as the Khronos specification says",
      bare(render::section_parameters(d, "material.0")))});
  for (const auto& info : bsdf_model_infos()) {
    const BsdfModelDescription& model = info.description;
    json j = entry(model.name, model.label, model.doc, info.parameters);
    j["class"] = Options<ModelClass>::kOptions[static_cast<size_t>(model.kind)].name;
    j["sampling"] = model.sampling, j["presets"] = presets(info.presets);
    list.push_back(j);
  }
  return list;
}

json lights() {
  json list = json::array();
  const auto add = [&](const char* name, const char* label, const char* doc, LightType type) {
    list.push_back(entry(name, label, doc, bare(render::section_parameters(with_one_light(type), "light.0"))));
  };
  list.push_back(entry("area", "Emissive triangles",
                       "Every triangle of a material with emission; its parameters are the material's", {}));
  add("point", "Point light", "Radiant intensity the same in all directions", LightType::point);
  add("spot", "Spot light", "A point light that shines into a cone", LightType::spot);
  add("directional", "Directional light", "Parallel light from infinity", LightType::directional);
  add("quad", "Quad light",
      "A rectangle that shines, black and seen by rays; directions to it are sampled from near by", LightType::quad);
  add("disk", "Disk light", "A disk that shines, exactly round; its points are sampled", LightType::disk);
  add("sphere", "Sphere light", "A sphere that shines, exactly round; the cone that it fills is sampled",
      LightType::sphere);
  add("ambient", "Ambient light",
      "Not physical: radiance from everywhere at every place, which casts no shadows; methods that walk from lights "
      "alone "
      "do not find it",
      LightType::ambient);
  list.push_back(entry("environment", "Environment", "Radiance from infinity, constant or from an equirectangular map",
                       bare(render::section_parameters(with_one_light(LightType::point), "environment"))));
  return list;
}

json media() {
  return json::array(
      {entry("absorbing", "Absorbing solid",
             "Beer's law inside a solid of KHR_materials_volume; its parameters are the material's", {})});
}

json scenes() {
  json list = json::array();
  for (const scene::Builtin& b : scene::builtins()) list.push_back(entry(b.name, b.label, b.doc, {}));
  return list;
}

json widgets() { return json::parse(viewer::widgets_json()); }

struct Registry {
  const char* name;
  json (*make)();
};
constexpr Registry kRegistries[] = {{"integrators", integrators}, {"samplers", samplers}, {"materials", materials},
                                    {"lights", lights},           {"media", media},       {"scenes", scenes},
                                    {"widgets", widgets}};

// Numbers as people write them: settings are floats, and six digits name a float.
std::string words(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number_float()) return value.dump();
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value.get<double>());
  return text;
}

void print_parameter(const json& p) {
  std::string range;
  if (!p["min"].is_null()) range = words(p["min"]) + " to " + words(p["max"]);
  if (p.contains("options"))
    for (const auto& option : p["options"]) range += (range.empty() ? "" : ", ") + words(option);
  if (range.empty()) range = "true, false";
  const std::string unit = words(p["unit"]);
  std::printf("    %-22s %s [%s] default %s%s\n", words(p["name"]).c_str(), words(p["doc"]).c_str(), range.c_str(),
              words(p["default"]).c_str(), unit.empty() ? "" : (" " + unit).c_str());
}

void print(const json& list) {
  for (const auto& e : list) {
    std::printf("%s: %s\n  %s\n", e["name"].get<std::string>().c_str(), e["label"].get<std::string>().c_str(),
                e["doc"].get<std::string>().c_str());
    if (e.contains("paths"))
      std::printf("  %s; paths %s, %s\n  fails: %s\n", e["group"].get<std::string>().c_str(),
                  e["paths"].get<std::string>().c_str(), e["bias"].get<std::string>().c_str(),
                  e["fails"].get<std::string>().c_str());
    for (const auto& p : e["parameters"]) print_parameter(p);
  }
}

}  // namespace

Command add_list(CLI::App& app) {
  struct Options {
    std::string kind;
    bool json = false;
  };
  auto o = std::make_shared<Options>();
  app.add_option("kind", o->kind, "integrators, samplers, materials, lights, media, scenes or widgets")->required();
  app.add_flag("--json", o->json, "Print JSON");
  return [o] {
    for (const auto& registry : kRegistries) {
      if (o->kind != registry.name) continue;
      const json list = registry.make();
      if (o->json)
        std::printf("%s\n", list.dump(2).c_str());
      else
        print(list);
      return 0;
    }
    std::string known;
    for (const auto& registry : kRegistries) known += (known.empty() ? "" : ", ") + std::string(registry.name);
    return fail(usage_error("list: there is no registry '" + o->kind + "'; there are " + known));
  };
}

}  // namespace etendue::cli
