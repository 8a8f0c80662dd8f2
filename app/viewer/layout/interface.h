// The panels of the right column and the other parts of the interface, one file each.
#pragma once
#include "viewer/state/app_state.h"

struct ImDrawList;

namespace etendue::viewer {

void draw_render_panel(Workbench& w);
// Its group that ranks methods.
void draw_advice(Workbench& w);
void draw_scene_panel(Workbench& w);
void draw_material_panel(Workbench& w);
// The verdicts on a surface, one line each.
void draw_badges(Workbench& w, const SurfaceReading& reading);
void draw_light_panel(Workbench& w);
// Its group with the light meter.
void draw_meter(Workbench& w);
void draw_camera_panel(Workbench& w);
void draw_display_panel(Workbench& w);

void draw_menu_bar(Workbench& w);
void draw_status_bar(Workbench& w, float top, float height);
void draw_palette(Workbench& w);
void draw_help(Workbench& w);
void draw_notices(Workbench& w);
void draw_loading(Workbench& w);

// What the hands do over the picture, and what is drawn on it.
void handle_viewport(Workbench& w, float seconds);
void draw_viewport_overlay(Workbench& w);

// A veil over the tiles of the picture whose samples have heavy tails.
void draw_health_map(const Workbench& w, const render::Reliability& health, ImDrawList* draw);

// Which pixel the sampling sheet is about.
void draw_pixel_marker(Workbench& w, ImDrawList* draw);

// Where the light meter lies.
void draw_meter_marker(Workbench& w, ImDrawList* draw);

// The same for two pictures that are compared. True while they hold the divider; `over`: they are over the picture.
bool handle_divider(Workbench& w, bool over);
void draw_comparison_overlay(Workbench& w, ImDrawList* draw);
// Where the divider of a wipe stands in the window, in whole pixels.
float divider_x(const Workbench& w);

// All of it for one frame: where everything lies and what is in it.
void draw_interface(Workbench& w, float seconds);

struct TabInfo {
  Tab tab;
  const char* name;  // of its item: "tab.render"
  const char* label;
  const char* doc;
  void (*draw)(Workbench&);
};
const std::vector<TabInfo>& tabs();

// The tab that holds the widgets of a setting, and what has to be selected for it to be shown; false for a name of no
// section.
bool reveal(Workbench& w, const std::string& setting);

}  // namespace etendue::viewer
