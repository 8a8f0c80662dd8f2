#include "sample_difference.h"

#include <algorithm>

#include "render/document.h"

namespace etendue::cli {

std::string sample_difference(const render::Document& a, const render::Document& b) {
  const auto values_differ = [](const std::string& name, const std::string& x, const std::string& y) {
    return x == y ? "" : name + " is " + x + ", not " + y;
  };
  for (const std::string& section : render::sections(a)) {
    if (section == "display") continue;
    const auto of_a = render::section_parameters(a, section), of_b = render::section_parameters(b, section);
    for (size_t i = 0; i < std::min(of_a.size(), of_b.size()); ++i) {
      const ParameterInfo& info = of_a[i].info;
      if (info.name == "camera.exposure") continue;
      const std::string text =
          values_differ(info.name, to_string(info.default_value), to_string(of_b[i].info.default_value));
      if (!text.empty()) return text;
    }
  }
  return values_differ("the environment map", a.scene->environment.file, b.scene->environment.file);
}

}  // namespace etendue::cli
