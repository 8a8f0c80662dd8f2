#include "support/random_editor.h"

#include <string>

#include "light/light.h"

namespace etendue::test {

using scene::EditKind;

void RandomEditor::undo() {
  if (undo_.empty()) return;
  redo_.push_back(std::exchange(document_, undo_.back()));
  undo_.pop_back();
}

void RandomEditor::redo() {
  if (redo_.empty()) return;
  undo_.push_back(std::exchange(document_, redo_.back()));
  redo_.pop_back();
}

scene::StructuralEdit RandomEditor::adding(EditKind kind) {
  scene::StructuralEdit edit;
  edit.kind = kind;
  edit.name = "object " + std::to_string(below(1000));
  const auto& lights = light_type_infos();
  const auto& shapes = scene::shape_types();
  if (kind == EditKind::add_light) edit.type = lights[below(lights.size())].description.name;
  if (kind == EditKind::add_shape) edit.type = shapes[below(shapes.size())].name;
  edit.transform.translation = {between(-0.8f, 0.8f), between(-0.8f, 0.8f), between(-0.8f, 0.8f)};
  edit.transform.scale = Vec3(between(0.02f, 0.2f));
  return edit;
}

void RandomEditor::apply(const scene::StructuralEdit& edit) {
  if (auto changed = render::with_structural_edit(document_, edit)) step(std::move(*changed));
}

void RandomEditor::step(render::Document changed) {
  ++done_;
  undo_.push_back(std::exchange(document_, std::move(changed)));
  redo_.clear();
}

}  // namespace etendue::test
