// The source text of the files in shaders/, embedded by CMake.
#pragma once

namespace etendue::viewer {

extern const char* const k_screen_vert;
extern const char* const k_display_frag;

}  // namespace etendue::viewer
