#include "render/document.h"

#include "base/similar_name.h"
#include "integrator/integrator.h"
#include "light/environments/builtin_environment.h"
#include "scene/builtin/builtin.h"
#include "scene/environment_file.h"
#include "transport/model.h"

namespace etendue::render {
namespace {

// The known parameter name that is most similar to `name`.
std::string nearest_name(const Document& document, std::string_view name) {
  std::vector<std::string> names;
  for (const auto& section : sections(document))
    for (const auto& parameter : section_parameters(document, section)) names.push_back(parameter.info.name);
  return similar_name(name, names);
}

// "material.3.roughness" -> "material.3", "film.width" -> "film"; empty for an unqualified name.
std::string_view section_of(std::string_view name) {
  const size_t dot = name.find('.');
  if (dot == std::string_view::npos) return {};
  const std::string_view first = name.substr(0, dot);
  if (first != "material" && first != "light" && first != "node") return first;
  const size_t second = name.find('.', dot + 1);
  return second == std::string_view::npos ? first : name.substr(0, second);
}

Result<DocumentParameter> find_document_parameter(const Document& document, std::string_view name) {
  if (name.find('.') == std::string_view::npos)
    for (const std::string& owner : {document.method.integrator, document.method.sampler, std::string("render")})
      for (auto& parameter : section_parameters(document, owner))
        if (parameter.info.name == owner + "." + std::string(name)) return parameter;
  for (auto& parameter : section_parameters(document, section_of(name)))
    if (parameter.info.name == name) return parameter;
  return usage_error("there is no parameter '" + std::string(name) + "'; the nearest name is '" +
                     nearest_name(document, name) + "'");
}

}  // namespace

std::vector<Setting> MethodSettings::settings_of(std::string_view owner) const {
  std::vector<Setting> list;
  for (const auto& [name, value] : settings)
    if (name.size() > owner.size() && name.starts_with(owner) && name[owner.size()] == '.')
      list.push_back({name.substr(owner.size() + 1), value});
  return list;
}

Result<Value> get(const Document& document, std::string_view name) {
  auto parameter = find_document_parameter(document, name);
  if (!parameter) return parameter.error();
  return parameter->info.default_value;
}

Result<Document> with(const Document& document, std::string_view name, const Value& value) {
  auto parameter = find_document_parameter(document, name);
  if (!parameter) return parameter.error();
  auto checked = checked_value(parameter->info, value);
  if (!checked) return checked.error();
  Document changed = document;
  parameter->assign(changed, *checked);
  return changed;
}

Result<Document> with_text(const Document& document, std::string_view name, std::string_view text) {
  auto parameter = find_document_parameter(document, name);
  if (!parameter) return parameter.error();
  auto value = parse_value(parameter->info, text);
  if (!value) return value.error();
  Document changed = document;
  parameter->assign(changed, *value);
  return changed;
}

namespace {

// The edit that `edit` makes ineffective, or null: one of the last keyframes, if it is that of the same object at the same
// time. A drag sets the keyframes of all selected objects again and again. An edit that adds its animation is kept.
scene::StructuralEdit* replaced_by(const scene::StructuralEdit& edit, std::vector<scene::StructuralEdit>& structure) {
  using scene::EditKind;
  if (edit.kind != EditKind::set_keyframe || edit.animation < 0) return nullptr;
  for (auto last = structure.rbegin(); last != structure.rend() && last->kind == EditKind::set_keyframe; ++last)
    if (last->node == edit.node && last->animation == edit.animation && last->time == edit.time) return &*last;
  return nullptr;
}

}  // namespace

Result<Document> with_structural_edit(const Document& document, const scene::StructuralEdit& edit) {
  scene::StructuralEdit complete = edit;
  if (const auto ok = scene::read_image(complete); !ok) return ok.error();
  auto scene = scene::with_edit(*document.scene, complete);
  if (!scene) return scene.error();
  Document changed = document;
  changed.scene = std::make_shared<const scene::Scene>(std::move(*scene));
  if (scene::StructuralEdit* replaced = replaced_by(complete, changed.structure))
    *replaced = std::move(complete);
  else
    changed.structure.push_back(std::move(complete));
  return changed;
}

Result<Document> with_environment(const Document& document, const std::string& file) {
  auto environment = scene::load_environment(file);
  if (!environment) return environment.error();
  const Environment& old = document.scene->environment;
  environment->rotation = old.rotation;
  // A map is a background of its own.
  environment->visible = old.visible || (old.backdrop && !find_builtin_environment(file));
  environment->backdrop = old.backdrop;
  environment->backdrop_brightness = old.backdrop_brightness;
  Document changed = document;
  auto scene = std::make_shared<scene::Scene>(*document.scene);
  scene->environment = std::move(*environment);
  changed.scene = std::move(scene);
  return changed;
}

}  // namespace etendue::render
