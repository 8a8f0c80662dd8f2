// etendue inspect: what is in a scene, what the loader gave up, and the transport model it needs.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "bsdf_analysis/plausibility.h"
#include "command.h"
#include "render/document.h"
#include "scene/builtin/builtin.h"
#include "scene/compiled_scene.h"
#include "transport/model.h"

namespace etendue::cli {
namespace {

using nlohmann::json;

// Surfaces that send back more light than they get from some direction.
json makers_of_light(const scene::CompiledScene& compiled) {
  std::set<uint32_t> used;
  for (const auto& instance : compiled.instances()) used.insert(instance.material);
  json makers = json::array();
  for (const uint32_t index : used) {
    const Material& material = compiled.materials()[index].description;
    const auto curve = bsdf_analysis::albedo_curve(bsdf_analysis::lobes_of(material), false, {20, 512});
    const bsdf_analysis::Plausibility p = bsdf_analysis::plausibility({}, curve);
    if (!p.conserves_energy())
      makers.push_back({{"material", material.name},
                        {"albedo", max_component(p.largest_albedo.value)},
                        {"degrees", p.largest_albedo.degrees},
                        {"hemispherical", bsdf_analysis::hemispherical_albedo(curve)}});
  }
  return makers;
}

json description_of(const render::Document& d, const scene::CompiledScene& compiled, const transport::Model& model) {
  json cameras = json::array(), flags = json::object();
  for (const auto& camera : scene::placed_cameras(*d.scene)) cameras.push_back(camera.name);
  for (const auto& decision : model.decisions)
    flags[decision.flag] = {{"value", decision.value}, {"reason", decision.reason}};
  return {{"scene", d.scene_name},
          {"triangles", compiled.triangle_count()},
          {"instances", compiled.instances().size()},
          {"materials", d.scene->materials.size()},
          {"textures", d.scene->textures.size()},
          {"lights", compiled.lights().size()},
          {"emissive_triangles", compiled.lights().triangles().size()},
          {"animations", d.scene->animations.size()},
          {"scenes", d.scene->scene_names},
          {"variants", d.scene->variants},
          {"cameras", cameras},
          {"unsupported", d.scene->unsupported},
          {"warnings", d.scene->warnings},
          {"makes_light", makers_of_light(compiled)},
          {"memory_bytes", compiled.memory()},
          {"model", flags}};
}

void print_list(const char* title, const json& items) {
  if (items.empty()) return;
  std::printf("%s\n", title);
  for (const auto& item : items) std::printf("  %s\n", item.get<std::string>().c_str());
}

void print(const json& j) {
  const auto number = [&](const char* key) { return j[key].get<unsigned long long>(); };
  std::printf("%s\n  %llu triangles, %llu instances, %llu materials, %llu textures, %llu lights\n",
              j["scene"].get<std::string>().c_str(), number("triangles"), number("instances"), number("materials"),
              number("textures"), number("lights"));
  print_list("cameras", j["cameras"]);
  print_list("variants of the materials (--set scene.variant=NAME)", j["variants"]);
  print_list("extensions that are ignored", j["unsupported"]);
  print_list("warnings", j["warnings"]);
  if (!j["makes_light"].empty()) std::printf("surfaces that make light\n");
  for (const auto& m : j["makes_light"])
    std::printf("  %-22s up to %.3g times what comes, at %.4g degrees; %.3g of light from everywhere\n",
                m["material"].get<std::string>().c_str(), m["albedo"].get<double>(), m["degrees"].get<double>(),
                m["hemispherical"].get<double>());
  std::printf("transport model\n");
  for (const auto& [flag, decision] : j["model"].items())
    std::printf("  %-13s %-11s %s\n", flag.c_str(), decision["value"].get<std::string>().c_str(),
                decision["reason"].get<std::string>().c_str());
}

}  // namespace

Command add_inspect(CLI::App& app) {
  struct Options {
    std::string scene;
    bool json = false;
  };
  auto o = std::make_shared<Options>();
  app.add_option("scene", o->scene, "A .gltf or .glb file, or one of " + scene::builtin_names())->required();
  app.add_flag("--json", o->json, "Print JSON");
  return [o] {
    const auto document = render::new_document(o->scene);
    if (!document) return fail(document.error());
    const auto compiled = scene::compile(document->scene, document->camera, nullptr);
    const json description = description_of(*document, *compiled, transport::model_for(*compiled));
    if (o->json)
      std::printf("%s\n", description.dump(2).c_str());
    else
      print(description);
    return 0;
  };
}

}  // namespace etendue::cli
