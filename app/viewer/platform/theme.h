// Colours and faces of the interface: a calm dark theme and a light one, every text at 4.5:1 or better on its ground.
#pragma once
#include <imgui.h>

namespace etendue::viewer {

struct Theme {
  bool dark = true;
  ImVec4 ground, panel, text, quiet, accent, warning;  // quiet: labels and figures that are not the point
};

// The faces that every panel uses; loaded at the display's scale.
struct Faces {
  ImFont* text = nullptr;     // proportional, for words
  ImFont* figures = nullptr;  // tabular, for numbers
  ImFont* small = nullptr;    // tabular, for charts and tables
};

Theme apply_theme(bool dark, float scale);
Faces load_faces(float scale);

}  // namespace etendue::viewer
