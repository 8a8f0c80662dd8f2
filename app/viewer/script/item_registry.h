// The names of what is on screen: where each item was drawn, and what a script wants of it.
//
// A script reaches a widget only through here: it asks for a value by name, and the widget of that name, when it is
// drawn, takes the value on the way that a hand's value would take. What is not drawn cannot be set.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "viewer/viewport/image_view.h"

namespace etendue::viewer {

class Items {
 public:
  void begin_frame() { placed_.clear(); }

  // Remembers the place of the ImGui item that was drawn last.
  void place(const std::string& name);
  // The same of what is no ImGui item.
  void place(const std::string& name, const Placement& at) { placed_[name] = at; }
  // Where an item was drawn in this frame.
  const Placement* find(const std::string& name) const;

  void request(const std::string& name, const std::string& value);
  bool wanted(std::string_view name) const { return request_ && request_->name == name; }
  bool wanted_below(std::string_view prefix) const { return request_ && request_->name.starts_with(prefix); }
  // Has this item brought into sight when it is drawn outside of it, until another is sought.
  void seek(const std::string& name) { sought_ = name; }
  // For the widget: the value asked for, once; the widget then answers with what was wrong, or nothing.
  std::optional<std::string> take(const std::string& name);
  void answer(const std::string& error);

  // For the script: nothing while no widget has answered.
  std::optional<std::string> take_answer();
  void cancel() { request_.reset(); }

 private:
  struct Request {
    std::string name, value;
  };
  std::map<std::string, Placement, std::less<>> placed_;
  std::optional<Request> request_;
  std::string sought_;
  std::optional<std::string> answer_;
};

}  // namespace etendue::viewer
