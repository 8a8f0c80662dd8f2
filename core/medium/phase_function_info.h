// The description of a phase function: what menus, `etendue list phase-functions` and the generated manual print.
#pragma once
#include <source_location>
#include <vector>

#include "base/parameter.h"

namespace etendue {

// Texts are plain ASCII. Formulas use x for the cosine of the scattering angle; x = 1 is forward scattering.
struct PhaseFunctionDescription {
  const char* name = "";         // identifier in commands and files, e.g. "henyey-greenstein"
  const char* label = "";        // shown in menus
  const char* summary = "";      // one or two sentences
  const char* formula = "";      // p in 1/sr
  const char* mean_cosine = "";  // formula or method
  const char* sampling = "";     // how cosines are sampled
  const char* limitations = "";  // known deviations from physics or from the source
  const char* source = "";       // keys of docs/references.md
  // The source file that contains the description, for the manual.
  const char* file = std::source_location::current().file_name();
};

struct PhaseFunctionInfo {
  PhaseFunctionDescription description;
  std::vector<ParameterInfo> parameters;
};

}  // namespace etendue
