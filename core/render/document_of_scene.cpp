#include "render/document_of_scene.h"

#include <algorithm>
#include <cmath>

#include "render/default_light.h"
#include "scene/builtin/builtin.h"

namespace etendue::render {
namespace {

// Whether the author of a scene provided light. An emission of at most one, which is all that glTF can state without
// KHR_materials_emissive_strength, does not count: it usually marks glowing parts (the headlights of a toy car) that
// are not meant to illuminate the scene.
bool is_lit(const scene::Scene& s) {
  constexpr float kStrongestGlow = 1;
  return !s.environment.black() || std::ranges::any_of(s.nodes, [](const auto& n) {
    return n.light >= 0;
  }) || std::ranges::any_of(s.materials, [](const auto& m) {
    return max_component(m.emission) > kStrongestGlow || (m.is_solid() && m.medium.emits());
  }) || s.atmosphere.medium.emits();
}

}  // namespace

Result<Document> new_document(const std::string& scene_file_or_name, const std::string& camera) {
  return new_document(scene_file_or_name, camera, scene::LoadOptions());
}

Result<Document> new_document(const std::string& scene_file_or_name, const std::string& camera,
                              const scene::LoadOptions& options) {
  auto loaded = scene::load(scene_file_or_name, options);
  if (!loaded) return loaded.error();
  return document_of(std::move(*loaded), scene_file_or_name, camera);
}

Result<Document> document_of(scene::Scene s, const std::string& scene_file_or_name, const std::string& camera) {
  auto chosen = scene::choose_camera(s, camera);
  if (!chosen) return Error{Fault::usage, scene_file_or_name + ": " + chosen.error().message};

  Document document;
  if (!is_lit(s)) {
    document.lit_by_default = true;
    document.display.curve = image::ToneCurve::neutral;
    s.environment = default_environment();
    s.warnings.emplace_back(kNoLightWarning);
  }
  document.scene_name = scene_file_or_name;
  document.camera_name = camera;
  document.camera = *chosen;
  if (chosen->aspect > 0)
    document.width = std::max(1, static_cast<int>(std::lround(static_cast<float>(document.height) * chosen->aspect)));
  document.scene = std::make_shared<const scene::Scene>(std::move(s));
  document.origin = std::make_shared<const Document>(document);
  return document;
}

}  // namespace etendue::render
