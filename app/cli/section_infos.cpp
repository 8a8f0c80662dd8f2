#include "section_infos.h"

#include <memory>

namespace etendue::cli {

render::Document sample_document(std::string_view light_type) {
  auto scene = std::make_shared<scene::Scene>();
  scene->materials.emplace_back();
  scene->lights.push_back(make_light(light_type));
  render::Document d;
  d.scene = scene;
  return d;
}

std::vector<ParameterInfo> section_infos(const render::Document& document, const std::string& section) {
  std::vector<ParameterInfo> infos;
  for (const auto& parameter : render::section_parameters(document, section)) {
    infos.push_back(parameter.info);
    infos.back().name = parameter.info.name.substr(section.size() + 1);
  }
  return infos;
}

}  // namespace etendue::cli
