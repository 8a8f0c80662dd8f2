// The warning about scenes to which new_document has added an environment.
#pragma once
#include <string>
#include <vector>

#include "render/document.h"

namespace etendue::render {

inline constexpr const char* kNoLightWarning = "no lights in the file: the studio environment was added";

// The warnings of the scene, without that one if another environment has replaced the added one.
inline std::vector<std::string> current_warnings(const Document& document) {
  std::vector<std::string> warnings = document.scene->warnings;
  if (document.scene->environment.file != "studio") std::erase(warnings, kNoLightWarning);
  return warnings;
}

}  // namespace etendue::render
