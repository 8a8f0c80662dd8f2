// Icons of lights and cameras over the image.
#pragma once
#include "base/vec.h"

struct ImDrawList;

namespace etendue::viewer {

struct AppState;

// Draws an icon at each light and camera in front of the current view, and registers it as "icon.N" for node N.
void draw_object_icons(AppState& state, ImDrawList& draw);
// Selects the object whose icon is at this position. Returns false if there is none.
bool select_icon_at(AppState& state, Vec2 position);
// The node of the icon at a position; -1 if there is none.
int icon_at(const AppState& state, Vec2 position);

}  // namespace etendue::viewer
