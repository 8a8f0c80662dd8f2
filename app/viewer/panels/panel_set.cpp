#include "viewer/panels/panel_set.h"

#include <algorithm>
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

bool PanelSet::is_detached(const Panel& panel) const {
  return std::ranges::find(detached_, &panel) != detached_.end();
}

void PanelSet::detach(Panel& panel) {
  if (is_detached(panel)) return;
  detached_.push_back(&panel);
  if (&panel == open_bottom_panel_) open_bottom_panel_ = nullptr;
  if (&panel != open_tab_) return;
  open_tab_ = nullptr;
  for (const auto& other : panels_)
    if (!open_tab_ && other->info().place == PanelPlace::right_column && !is_detached(*other)) open_tab_ = other.get();
}

void PanelSet::attach(Panel& panel) {
  if (std::erase(detached_, &panel) == 0) return;
  if (panel.info().place == PanelPlace::right_column) open(panel);
}

void PanelSet::open(Panel& panel) {
  if (is_detached(panel)) return;
  if (panel.info().place == PanelPlace::bottom) {
    open_bottom_panel_ = &panel;
    return;
  }
  open_tab_ = &panel;
  requested_tab_ = &panel;
}

void PanelSet::toggle(Panel& panel) {
  if (is_detached(panel)) return attach(panel);
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
