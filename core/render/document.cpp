#include "render/document.h"

#include <algorithm>

#include "integrator/integrator.h"
#include "render/document_parameters.h"
#include "scene/builtin/builtin.h"
#include "scene/environment.h"
#include "transport/model.h"

namespace etendue::render {
namespace {

// Edit distance, for "did you mean".
size_t distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = std::exchange(row[0], i);
    for (size_t j = 1; j <= b.size(); ++j)
      diagonal =
          std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1] ? 1 : 0)}));
  }
  return row.back();
}

std::string nearest_name(const Document& document, std::string_view name) {
  std::string best;
  size_t least = SIZE_MAX;
  for (const auto& section : sections(document))
    for (const auto& b : section_parameters(document, section))
      if (const size_t d = distance(name, b.info.name); d < least) least = d, best = b.info.name;
  return best;
}

std::string_view section_of(std::string_view name) {
  const size_t dot = name.find('.');
  if (dot == std::string_view::npos) return {};
  const std::string_view first = name.substr(0, dot);
  if (first != "material" && first != "light" && first != "node") return first;
  const size_t second = name.find('.', dot + 1);
  return second == std::string_view::npos ? first : name.substr(0, second);
}

Result<DocumentParameter> find_binding(const Document& document, std::string_view name) {
  // A bare name belongs to the integrator, else to the sampler, else to the rendering as a whole.
  if (name.find('.') == std::string_view::npos)
    for (const std::string& owner : {document.method.integrator, document.method.sampler, std::string("render")})
      for (auto& b : section_parameters(document, owner))
        if (b.info.name == owner + "." + std::string(name)) return b;
  for (auto& b : section_parameters(document, section_of(name)))
    if (b.info.name == name) return b;
  return usage_error("there is no setting '" + std::string(name) + "'; the nearest is '" +
                     nearest_name(document, name) + "'");
}

}  // namespace

std::vector<Setting> MethodSettings::settings_of(std::string_view owner) const {
  std::vector<Setting> own;
  for (const auto& [name, value] : settings)
    if (name.size() > owner.size() && name.starts_with(owner) && name[owner.size()] == '.')
      own.push_back({name.substr(owner.size() + 1), value});
  return own;
}

Result<Value> get(const Document& document, std::string_view name) {
  auto binding = find_binding(document, name);
  if (!binding) return binding.error();
  return binding->info.default_value;
}

Result<Document> with(const Document& document, std::string_view name, const Value& value) {
  auto binding = find_binding(document, name);
  if (!binding) return binding.error();
  auto checked = checked_value(binding->info, value);
  if (!checked) return checked.error();
  Document changed = document;
  binding->assign(changed, *checked);
  return changed;
}

Result<Document> with_text(const Document& document, std::string_view name, std::string_view text) {
  auto binding = find_binding(document, name);
  if (!binding) return binding.error();
  auto value = parse_value(binding->info, text);
  if (!value) return value.error();
  Document changed = document;
  binding->assign(changed, *value);
  return changed;
}

namespace {

// Whether an author lit the scene. Emission of one at most, all that glTF has without KHR_materials_emissive_strength,
// is a glow to be seen (the headlights of a toy car), not a light to see by.
bool is_lit(const scene::Scene& s) {
  constexpr float kGlow = 1;
  return !s.environment.black() || std::ranges::any_of(s.nodes, [](const auto& n) { return n.light >= 0; }) ||
         std::ranges::any_of(s.materials, [](const auto& m) { return max_component(m.emission) > kGlow; });
}

}  // namespace

Result<Document> new_document(const std::string& scene_file_or_name, const std::string& camera) {
  auto loaded = scene::load(scene_file_or_name);
  if (!loaded) return loaded.error();
  scene::Scene& s = *loaded;
  auto chosen = scene::choose_camera(s, camera);
  if (!chosen) return Error{Fault::usage, scene_file_or_name + ": " + chosen.error().message};

  Document document;
  if (!is_lit(s)) {
    document.lit_by_default = true;
    s.environment.tint = Rgb(1);
    s.warnings.push_back("the scene has no light to be seen by; a neutral environment of radiance 1 was added");
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

Result<Document> with_environment(const Document& document, const std::string& file) {
  auto map = scene::load_environment_map(file);
  if (!map) return map.error();
  Document changed = document;
  auto scene = std::make_shared<scene::Scene>(*document.scene);
  const float rotation = scene->environment.rotation;
  scene->environment = Environment{*map, file, Rgb(1), rotation, scene->environment.visible};
  changed.scene = std::move(scene);
  return changed;
}

}  // namespace etendue::render
