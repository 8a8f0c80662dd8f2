#include "viewer/panels/panel_set.h"

#include <utility>

namespace etendue::viewer {

PanelSet::PanelSet(std::vector<std::unique_ptr<Panel>> panels) : panels_(std::move(panels)) {
  for (const auto& panel : panels_)
    if (!open_tab_ && panel->info().place == PanelPlace::right_column) open_tab_ = panel.get();
}

Panel* PanelSet::find(std::string_view name) const {
  for (const auto& panel : panels_)
    if (panel->info().name == name) return panel.get();
  return nullptr;
}

void PanelSet::open(Panel& panel) {
  if (panel.info().place == PanelPlace::bottom) {
    open_bottom_panel_ = &panel;
    return;
  }
  open_tab_ = &panel;
  requested_tab_ = &panel;
}

void PanelSet::toggle(Panel& panel) {
  if (&panel == open_bottom_panel_)
    open_bottom_panel_ = nullptr;
  else
    open(panel);
}

bool PanelSet::reveal_parameter(AppState& state, const std::string& name) {
  for (const auto& panel : panels_) {
    if (!panel->reveal_parameter(state, name)) continue;
    open(*panel);
    return true;
  }
  return false;
}

Panel* PanelSet::take_requested_tab() { return std::exchange(requested_tab_, nullptr); }

}  // namespace etendue::viewer
