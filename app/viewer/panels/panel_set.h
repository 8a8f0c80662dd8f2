// All panels, and which of them are open: one tab of the right column, at most one bottom panel, and any number in windows
// of their own.
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "viewer/panels/panel.h"

namespace etendue::viewer {

class PanelSet {
 public:
  PanelSet() = default;
  // Opens the first tab of the right column.
  explicit PanelSet(std::vector<std::unique_ptr<Panel>> panels);

  const std::vector<std::unique_ptr<Panel>>& all() const { return panels_; }
  // Null if there is no panel of this name.
  Panel* find(std::string_view name) const;

  Panel* open_tab() const { return open_tab_; }
  // Null if the bottom panel is closed.
  Panel* open_bottom_panel() const { return open_bottom_panel_; }
  bool is_open(const Panel& panel) const {
    return &panel == open_tab_ || &panel == open_bottom_panel_ || is_detached(panel);
  }

  // A detached panel stays in its window.
  void open(Panel& panel);
  // Closes a bottom panel that is open, and returns a detached panel to its tab; otherwise opens the panel.
  void toggle(Panel& panel);

  // Panels in windows of their own, in the order in which they were detached.
  const std::vector<Panel*>& detached() const { return detached_; }
  bool is_detached(const Panel& panel) const;
  void detach(Panel& panel);
  // Returns a detached panel to its place; a tab of the right column is opened there.
  void attach(Panel& panel);
  // Opens the panel that has the widget of a parameter. Returns false if there is none.
  bool reveal_parameter(AppState& state, const std::string& name);

  // For the tab bar: the tab that the user has selected, and the tab to switch to, once.
  void set_selected_tab(Panel& panel) { open_tab_ = &panel; }
  Panel* take_requested_tab();

 private:
  std::vector<std::unique_ptr<Panel>> panels_;
  Panel* open_tab_ = nullptr;
  Panel* open_bottom_panel_ = nullptr;
  Panel* requested_tab_ = nullptr;
  std::vector<Panel*> detached_;
};

}  // namespace etendue::viewer
