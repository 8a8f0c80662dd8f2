// How the settings of each section of a document are described, read and written; document.h puts them to use.
#pragma once
#include <memory>
#include <string>
#include <utility>

#include "render/document.h"

namespace etendue::render {

// Makes one binding: the knob describes it (a Number, Toggle or Choice whose value is the value now), `store` puts the
// value of a knob back into a document.
template <class Knob, class Store>
DocumentParameter binding(const std::string& section, const Knob& knob, Store store) {
  DocumentParameter b;
  b.info = describe(knob);
  b.info.name = section + "." + b.info.name;
  b.section = section;
  b.assign = [knob, store](Document& document, const Value& value) {
    Knob changed = knob;
    etendue::assign(changed, value);
    store(document, changed.value);
  };
  return b;
}

// The scene is shared: an edit copies it (its heavy arrays stay shared) and changes the copy.
template <class F>
void edit_scene(Document& document, F&& f) {
  auto scene = std::make_shared<scene::Scene>(*document.scene);
  f(*scene);
  document.scene = std::move(scene);
}

std::vector<DocumentParameter> material_bindings(const Document& document, size_t index, const std::string& section);
std::vector<DocumentParameter> light_bindings(const Document& document, size_t index, const std::string& section);
std::vector<DocumentParameter> node_bindings(const Document& document, size_t index, const std::string& section);
std::vector<DocumentParameter> environment_bindings(const Document& document, const std::string& section);
std::vector<DocumentParameter> camera_bindings(const Document& document, const std::string& section);

}  // namespace etendue::render
