// The description of a density: what menus, `etendue list densities` and the generated manual print.
#pragma once
#include <source_location>
#include <vector>

#include "base/parameter.h"

namespace etendue {

// Texts are plain ASCII. Formulas use x, y, z for coordinates from -1 to 1 in the bounding box of the medium; y is up.
struct DensityDescription {
  const char* name = "";         // identifier in commands and files, e.g. "cloud"
  const char* label = "";        // shown in menus
  const char* summary = "";      // one or two sentences
  const char* formula = "";      // the density as a function of x, y, z
  const char* limitations = "";  // what the density does not represent
  const char* source = "";       // keys of docs/references.md
  // The source file that contains the description, for the manual.
  const char* file = std::source_location::current().file_name();
};

struct DensityInfo {
  DensityDescription description;
  std::vector<ParameterInfo> parameters;
};

}  // namespace etendue
