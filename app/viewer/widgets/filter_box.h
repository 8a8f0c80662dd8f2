// Text fields that select which parameters a panel shows.
#pragma once
#include <functional>
#include <string>

namespace etendue::viewer {

struct AppState;
struct UiContext;

// The field with a button that clears it. `item` is its name for scripts, ITEM.clear that of the button; `hint` is shown
// while it is empty.
void filter_box(UiContext& ui, const std::string& item, const char* hint, std::string& filter);

// The filter of the bottom panels, and below it the parameters that `draw` draws and that contain its text.
void filtered_parameters(AppState& state, const std::function<void()>& draw);

}  // namespace etendue::viewer
