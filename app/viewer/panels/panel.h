// Panels: the tabs of the right column and of the bottom panel.
//
// A panel is one source file that defines a class derived from Panel and a function make_NAME_panel, plus one line in
// panels/registry.cpp. The tab bars, the menus, the command palette, the list of widgets, the state report and the
// tests read the registry. A panel uses AppState and no other panel.
#pragma once
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "base/vec.h"
#include "viewer/script/item_registry.h"
#include "viewer/script/wait_condition.h"

struct ImDrawList;

namespace etendue::viewer {

struct AppState;
class ActionList;
class Task;

enum class PanelPlace : uint8_t { right_column, bottom };

struct PanelInfo {
  const char* name;         // of the tab, for scripts: "tab.render", "panel.convergence"
  const char* label;        // of the tab
  const char* description;  // one sentence: the tooltip of the tab
  PanelPlace place;
};

class Panel {
 public:
  Panel() = default;
  virtual ~Panel() = default;
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  virtual PanelInfo info() const = 0;
  // Draws the panel in the current ImGui window. A document is open.
  virtual void draw(AppState& state) = 0;

  // --- What the panel adds to lists
  // Parameters of the panel itself, as opposed to those of the document, with their defaults.
  virtual std::vector<ParameterInfo> parameters() const { return {}; }
  // Where a parameter of the panel is, for the command palette.
  virtual std::string place_of(const std::string& /*parameter*/) const { return info().label; }
  // Items that are neither actions nor parameters. N in a name stands for a number.
  virtual std::vector<ItemInfo> items() const { return {}; }
  virtual void add_actions(ActionList&) {}
  virtual std::vector<WaitCondition> wait_conditions() { return {}; }
  // Adds the state of the panel to the state report.
  virtual void report(AppState&, nlohmann::json&) {}

  // Whether the panel has a widget for a parameter. Selects the object that the parameter belongs to ("material.3").
  virtual bool reveal_parameter(AppState&, const std::string& name) {
    const auto list = parameters();
    return find_parameter(list, name) != nullptr;
  }

  // The value to which a parameter of the panel itself is reset; nothing if it has no such parameter.
  virtual std::optional<Value> default_value(const AppState&, const std::string& name) const {
    const auto list = parameters();
    const ParameterInfo* info = find_parameter(list, name);
    return info ? std::optional(info->default_value) : std::nullopt;
  }

  // --- Background work
  // Called once per frame before drawing, whether the panel is open or not.
  virtual void update(AppState&) {}
  // The tasks of this panel. The main loop resets them when another document is opened, and draws when they have
  // results.
  virtual std::vector<Task*> tasks() { return {}; }

  // --- The viewport
  // Called for a click in the image while the panel is open. Returns true if the panel has used it.
  virtual bool handle_click(AppState&, Vec2 /*position*/) { return false; }
  virtual void draw_overlay(AppState&, ImDrawList&) {}
};

}  // namespace etendue::viewer
