// How the parameters of each section of a document are described, read and written. document.h gives access to them by
// name.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/document.h"

namespace etendue::render {

using DocumentParameters = std::vector<DocumentParameter>;

inline constexpr float kLargestLength = 1e9f;  // metres

// A parameter that is described by a Number, a Toggle or a Choice with the current value. `store(document, value)`
// writes another value into a document.
template <class Description, class Store>
DocumentParameter make_parameter(const std::string& section, const Description& description, Store store) {
  DocumentParameter parameter;
  parameter.info = describe(description);
  parameter.info.name = section + "." + parameter.info.name;
  parameter.section = section;
  parameter.assign = [description, store](Document& document, const Value& value) {
    Description changed = description;
    etendue::assign(changed, value);
    store(document, changed.value);
  };
  return parameter;
}

// Changes the scene of a document. Scenes are shared between documents, so the change is made to a copy; its large
// arrays stay shared.
template <class F>
void edit_scene(Document& document, F&& edit) {
  auto scene = std::make_shared<scene::Scene>(*document.scene);
  edit(*scene);
  document.scene = std::move(scene);
}

// Three numbers with a common label. `store(document, component, value)` writes one of them.
struct TripleDescription {
  const char* names[3];
  const char* label;
  Vec3 value;
  Range<float> range;
  const char* doc;
  const char* unit = "";
};

template <class Store>
void add_triple(DocumentParameters& list, const std::string& section, const TripleDescription& triple, Store store) {
  for (int c = 0; c < 3; ++c)
    list.push_back(make_parameter(
        section, Number<float>{triple.names[c], triple.label, triple.value[c], triple.range, triple.doc, triple.unit},
        [store, c](Document& document, float v) { store(document, c, v); }));
}

// A choice whose options, value and assignment are still to be set.
inline DocumentParameter choice_parameter(const std::string& section, const std::string& name, const std::string& label,
                                          const std::string& doc) {
  DocumentParameter parameter;
  parameter.section = section;
  parameter.info.name = section + "." + name;
  parameter.info.label = label;
  parameter.info.doc = doc;
  parameter.info.type = ParameterType::choice;
  return parameter;
}

// One function per section, in the file of its name.
DocumentParameters render_parameters(const Document& document);
DocumentParameters automatic_parameters(const Document& document);
DocumentParameters film_parameters(const Document& document);
DocumentParameters display_parameters(const Document& document);
DocumentParameters scene_parameters(const Document& document);
DocumentParameters model_parameters(const Document& document);
DocumentParameters camera_parameters(const Document& document);
DocumentParameters environment_parameters(const Document& document);
DocumentParameters atmosphere_parameters(const Document& document);
DocumentParameters material_parameters(const Document& document, size_t index, const std::string& section);
DocumentParameters light_parameters(const Document& document, size_t index, const std::string& section);
DocumentParameters node_parameters(const Document& document, size_t index, const std::string& section);

// The number N of a section "KIND.N", such as "node.3", if it is below `count`.
std::optional<size_t> section_index(std::string_view section, std::string_view kind, size_t count);

}  // namespace etendue::render
