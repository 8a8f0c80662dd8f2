// The warning about scenes to which new_document has added an environment.
#pragma once

namespace etendue::render {

inline constexpr const char* kNoLightWarning = "no lights in the file: the studio environment was added";

}  // namespace etendue::render
