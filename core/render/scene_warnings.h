// Warnings about the scene of a document.
#pragma once
#include <string>
#include <vector>

#include "render/default_light.h"
#include "render/document.h"

namespace etendue::render {

// The warnings of the scene, without that about the studio environment if another one has replaced it.
inline std::vector<std::string> current_warnings(const Document& document) {
  std::vector<std::string> warnings = document.scene->warnings;
  if (document.scene->environment.file != "studio") std::erase(warnings, kNoLightWarning);
  return warnings;
}

}  // namespace etendue::render
