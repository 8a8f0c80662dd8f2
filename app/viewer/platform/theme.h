// Colours and fonts of the interface: a dark and a light theme, in which all text has a contrast of at least 4.5:1.
#pragma once
#include <imgui.h>

#include "viewer/platform/glyphs.h"

namespace etendue::viewer {

struct Theme {
  bool dark = true;
  ImVec4 background{};  // of the viewport, the menu bar and the status bar
  ImVec4 panel{};       // background of panels
  ImVec4 text{};
  ImVec4 secondary_text{};  // notes, axis labels and inactive items
  ImVec4 accent{};
  ImVec4 warning{};
};

// The fonts of the interface, loaded at the scale of the display.
struct Fonts {
  ImFont* text = nullptr;       // proportional
  ImFont* monospace = nullptr;  // for numbers
  ImFont* small = nullptr;      // small monospace, for charts and tables
};

// Sets the style of Dear ImGui. `scale` is in pixels per unit of the interface.
Theme apply_theme(bool dark, float scale);
// Replaces all fonts; `size` is the height of text in pixels. The host uploads them before the next frame. Characters of
// `glyphs` that a font lacks come from other installed fonts.
Fonts load_fonts(float size, const GlyphSet& glyphs);
// The number of characters that the font does not have.
size_t count_missing(const ImFont& font, const GlyphSet& glyphs);

}  // namespace etendue::viewer
