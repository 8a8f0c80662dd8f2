// The named items on screen: where each one was drawn, and the value that a script requests for it.
//
// A script reaches widgets only through this registry. It requests a value for a name. The widget of that name takes
// the value when it is drawn, and handles it like a value that the user enters. An item that is not drawn cannot be
// set.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "viewer/viewport/placement.h"

namespace etendue::viewer {

// The description of an item for `etendue list widgets`.
struct ItemInfo {
  std::string name;
  std::string label;
  std::string description;
};

class ItemRegistry {
 public:
  void begin_frame() {
    placements_.clear();
    fits_.clear();
    tooltip_.clear();
    ++frames_;
  }
  // The number of frames that were begun.
  uint64_t frames() const { return frames_; }

  // Records the placement of the last ImGui item under this name.
  void add(const std::string& name);
  // Records the placement of something that is not an ImGui item.
  void add(const std::string& name, const Placement& placement) { placements_[name] = placement; }
  // The placement of an item in this frame, or null if it was not drawn or is not visible.
  const Placement* find(const std::string& name) const;
  // All items that were drawn in this frame.
  const std::map<std::string, Placement, std::less<>>& placements() const { return placements_; }

  // Records whether a text of a parameter has room on screen: its label, or a value that it can have.
  void add_text(const std::string& parameter, bool fits) { fits_.try_emplace(parameter, true).first->second &= fits; }
  // Of all parameters that were drawn in this frame, scrolled out of view or not: whether all their texts have room.
  const std::map<std::string, bool>& fits() const { return fits_; }

  // The tooltip of the parameter under the pointer; empty if there is none.
  void set_tooltip(const std::string& text) { tooltip_ = text; }
  const std::string& tooltip() const { return tooltip_; }

  // --- for scripts
  // Requests a value for an item; replaces the previous request.
  void request(const std::string& name, const std::string& value);
  void cancel_request() { request_.reset(); }
  // The error message of the widget that took the request (empty if it succeeded). Nothing while no widget has
  // answered.
  std::optional<std::string> take_answer();
  // Scrolls this item into view in the next frames. An empty name ends that.
  void scroll_to(const std::string& name) { scroll_target_ = name; }
  const std::string& scroll_target() const { return scroll_target_; }

  // Scrolls this item into view and marks it for a moment.
  void point_out(const std::string& name);
  // The same, and requests a value for it during that time.
  void point_out(const std::string& name, const std::string& value);
  // The item that is marked; empty if there is none.
  const std::string& pointed_out() const { return pointed_out_; }
  // Ends the mark after its time.
  void advance(float seconds);

  // --- for widgets
  bool is_requested(std::string_view name) const { return request_ && request_->name == name; }
  bool is_requested_below(std::string_view prefix) const { return request_ && request_->name.starts_with(prefix); }
  // The value that a script requests for this item, once. The widget then calls `answer`.
  std::optional<std::string> take_request(const std::string& name);
  void answer(const std::string& error) { answer_ = error; }

 private:
  struct Request {
    std::string name;
    std::string value;
    bool ends_with_mark = false;
  };
  std::map<std::string, Placement, std::less<>> placements_;
  std::map<std::string, bool> fits_;
  std::string tooltip_;
  uint64_t frames_ = 0;
  std::optional<Request> request_;
  std::optional<std::string> answer_;
  std::string scroll_target_;
  std::string pointed_out_;
  float mark_seconds_ = 0;
};

}  // namespace etendue::viewer
