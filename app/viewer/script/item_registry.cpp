#include "viewer/script/item_registry.h"

#include <imgui.h>

#include <utility>

namespace etendue::viewer {

void Items::place(const std::string& name) {
  // A script that wants an item which is scrolled out of sight has it brought into sight.
  const ImVec2 least = ImGui::GetItemRectMin(), size = ImGui::GetItemRectSize();
  // Its middle is what is clicked.
  const ImVec2 middle{least.x + 0.5f * size.x, least.y + 0.5f * size.y};
  const ImVec2 first = ImGui::GetWindowDrawList()->GetClipRectMin(), end = ImGui::GetWindowDrawList()->GetClipRectMax();
  // A row of a table reaches beyond the column that it was drawn in.
  const float left = ImGui::GetWindowPos().x;
  const bool aside = middle.x < left || middle.x >= left + ImGui::GetWindowWidth();
  const bool hidden = aside || middle.y < first.y || middle.y >= end.y;
  if (!ImGui::IsItemVisible() || hidden) {
    if (!wanted(name) && name != sought_) return;
    ImGui::SetScrollHereY();
    if (aside) ImGui::SetScrollHereX();
    return;
  }
  placed_[name] = {Vec2(least.x, least.y), Vec2(size.x, size.y)};
}

const Placement* Items::find(const std::string& name) const {
  const auto found = placed_.find(name);
  return found == placed_.end() ? nullptr : &found->second;
}

void Items::request(const std::string& name, const std::string& value) {
  request_ = Request{name, value};
  answer_.reset();
}

std::optional<std::string> Items::take(const std::string& name) {
  if (!wanted(name) || answer_) return std::nullopt;
  std::string value = std::move(request_->value);
  request_.reset();
  return value;
}

void Items::answer(const std::string& error) { answer_ = error; }

std::optional<std::string> Items::take_answer() { return std::exchange(answer_, std::nullopt); }

}  // namespace etendue::viewer
