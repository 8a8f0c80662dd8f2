// The environment that new_document adds to scenes without lights, and the warning about it.
#pragma once
#include "light/environments/builtin_environment.h"

namespace etendue::render {

// The studio, with a grey backdrop in front of which white objects are visible.
inline Environment default_environment() {
  Environment environment = make_environment(builtin_environments().front());
  environment.visible = false;
  environment.backdrop = true;
  return environment;
}

inline constexpr const char* kNoLightWarning = "no lights in the file: the studio environment was added";

}  // namespace etendue::render
