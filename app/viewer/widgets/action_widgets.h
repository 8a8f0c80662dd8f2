// Buttons and menu entries for actions.
#pragma once

namespace etendue::viewer {

struct Action;
struct AppState;

// A button with the label and the tooltip of an action. It is highlighted while the action is checked.
void action_button(AppState& state, const char* name);

// A menu entry with the shortcut of an action.
void action_menu_item(AppState& state, const Action& action);

}  // namespace etendue::viewer
