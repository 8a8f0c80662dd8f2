// etendue inspect: the contents of a scene, what the importer had to ignore, and the transport model that it needs.
#include <cstdio>
#include <memory>
#include <set>

#include "base/json_text.h"
#include "bsdf_analysis/plausibility.h"
#include "command.h"
#include "json.h"
#include "render/scene_warnings.h"
#include "scene/compiled_scene.h"
#include "scene/light_counts.h"
#include "scene_options.h"
#include "transport/model.h"

namespace etendue::cli {
namespace {

// The used materials that reflect more light than they receive from some direction.
json non_conserving_materials(const scene::CompiledScene& compiled) {
  std::set<uint32_t> used;
  for (const auto& instance : compiled.instances()) used.insert(instance.material);
  json list = json::array();
  for (const uint32_t index : used) {
    const Material& material = compiled.materials()[index].description;
    const auto curve = bsdf_analysis::albedo_curve(bsdf_analysis::lobes_of(material), false, {20, 512});
    const bsdf_analysis::Plausibility p = bsdf_analysis::plausibility({}, curve);
    if (!p.conserves_energy())
      list.push_back({{"material", material.name},
                      {"albedo", max_component(p.largest_albedo.value)},
                      {"degrees", p.largest_albedo.degrees},
                      {"hemispherical", bsdf_analysis::hemispherical_albedo(curve)}});
  }
  return list;
}

json description_of(const render::Document& d, const scene::CompiledScene& compiled, const transport::Model& model) {
  json cameras = json::array(), flags = json::object();
  const scene::LightCounts lights = scene::count_lights(compiled);
  for (const auto& camera : scene::placed_cameras(*d.scene)) cameras.push_back(camera.name);
  for (const auto& decision : model.decisions)
    flags[decision.flag] = {{"value", decision.value}, {"reason", decision.reason}};
  return {{"scene", d.scene_name},
          {"triangles", compiled.triangle_count()},
          {"instances", compiled.instances().size()},
          {"materials", d.scene->materials.size()},
          {"textures", d.scene->textures.size()},
          {"lights", lights.total()},
          {"emissive_objects", lights.emissive_objects},
          {"emissive_triangles", lights.emissive_triangles},
          {"lights_text", scene::light_text(lights)},
          {"animations", d.scene->animations.size()},
          {"scenes", d.scene->scene_names},
          {"variants", d.scene->variants},
          {"cameras", cameras},
          {"unsupported", d.scene->unsupported},
          {"warnings", render::current_warnings(d)},
          {"makes_light", non_conserving_materials(compiled)},
          {"memory_bytes", compiled.memory()},
          {"model", flags}};
}

void print_list(const char* title, const json& items) {
  if (items.empty()) return;
  std::printf("%s\n", title);
  for (const auto& item : items) std::printf("  %s\n", item.get<std::string>().c_str());
}

void print(const json& j) {
  std::string counts;
  for (const auto& [singular, plural] : {std::pair("triangle", "triangles"),
                                         {"instance", "instances"},
                                         {"material", "materials"},
                                         {"texture", "textures"}})
    counts += (counts.empty() ? "" : ", ") + format_count(j[plural].get<uint64_t>(), singular, plural);
  std::printf("%s\n  %s\n  lights: %s\n", j["scene"].get<std::string>().c_str(), counts.c_str(),
              j["lights_text"].get<std::string>().c_str());
  print_list("cameras", j["cameras"]);
  print_list("material variants (--set scene.variant=NAME)", j["variants"]);
  print_list("unsupported extensions", j["unsupported"]);
  print_list("warnings", j["warnings"]);
  if (!j["makes_light"].empty()) std::printf("materials that do not conserve energy\n");
  for (const auto& m : j["makes_light"])
    std::printf("  %-22s albedo up to %.3g, at %.4g°; hemispherical albedo %.3g\n",
                m["material"].get<std::string>().c_str(), m["albedo"].get<double>(), m["degrees"].get<double>(),
                m["hemispherical"].get<double>());
  std::printf("transport model\n");
  for (const auto& [flag, decision] : j["model"].items())
    std::printf("  %-13s %-11s %s\n", flag.c_str(), decision["value"].get<std::string>().c_str(),
                decision["reason"].get<std::string>().c_str());
}

}  // namespace

Command inspect_command() {
  struct InspectArguments {
    std::string scene;
    bool json = false;
  };
  const auto a = std::make_shared<InspectArguments>();
  return {.name = "inspect",
          .summary = "Describe a scene and the transport model that it needs",
          .options = {scene_option(a->scene), json_flag(a->json)},
          .run = [a] {
            const auto document = render::new_document(a->scene);
            if (!document) return fail(document.error());
            const auto compiled = scene::compile(document->scene, document->camera, nullptr);
            const json description = description_of(*document, *compiled, transport::model_for(*compiled));
            if (a->json)
              std::printf("%s\n", json_text(description, 2).c_str());
            else
              print(description);
            return 0;
          }};
}

}  // namespace etendue::cli
