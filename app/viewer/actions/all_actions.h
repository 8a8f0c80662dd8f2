// The actions of the viewer, by topic. Actions of a single panel are defined in that panel.
#pragma once

namespace etendue::viewer {

class ActionList;
class PanelSet;

void add_file_actions(ActionList& actions);
void add_edit_actions(ActionList& actions);
void add_render_actions(ActionList& actions);
void add_integrator_actions(ActionList& actions);
void add_view_actions(ActionList& actions);
void add_zoom_actions(ActionList& actions);
void add_inspection_actions(ActionList& actions);
void add_object_actions(ActionList& actions);
void add_material_actions(ActionList& actions);
void add_comparison_actions(ActionList& actions);

// The actions of the panels, and for each panel an action "view.NAME" that opens it.
void add_panel_actions(ActionList& actions, const PanelSet& panels);

// All of the above.
void add_all_actions(ActionList& actions, const PanelSet& panels);

}  // namespace etendue::viewer
