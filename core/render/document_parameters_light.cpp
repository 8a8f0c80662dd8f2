// Sections "light.N": the parameters that the type of the light registers.
#include "render/document_parameters.h"

namespace etendue::render {

DocumentParameters light_parameters(const Document& document, size_t index, const std::string& section) {
  DocumentParameters list;
  for (const ParameterInfo& info : document.scene->lights[index].parameters()) {
    DocumentParameter parameter;
    parameter.section = section;
    parameter.info = info;
    parameter.info.name = section + "." + info.name;
    parameter.assign = [index, name = info.name](Document& d, const Value& v) {
      edit_scene(d, [&](scene::Scene& s) { s.lights[index].set(name, v); });
    };
    list.push_back(std::move(parameter));
  }
  return list;
}

}  // namespace etendue::render
