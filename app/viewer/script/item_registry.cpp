#include "viewer/script/item_registry.h"

#include <imgui.h>

#include <utility>

namespace etendue::viewer {

namespace {

constexpr float kMarkSeconds = 1.5f;

// A frame around an item.
void mark(const ImVec2& corner, const ImVec2& size) {
  const ImU32 color = ImGui::GetColorU32(ImGuiCol_CheckMark);
  ImGui::GetWindowDrawList()->AddRect({corner.x - 2, corner.y - 2}, {corner.x + size.x + 2, corner.y + size.y + 2},
                                      color, ImGui::GetStyle().FrameRounding, 0, 2);
}

}  // namespace

void ItemRegistry::point_out(const std::string& name) {
  pointed_out_ = name;
  mark_seconds_ = kMarkSeconds;
}

void ItemRegistry::point_out(const std::string& name, const std::string& value) {
  point_out(name);
  request(name, value);
  request_->ends_with_mark = true;
}

void ItemRegistry::advance(float seconds) {
  mark_seconds_ -= seconds;
  if (mark_seconds_ > 0) return;
  pointed_out_.clear();
  if (request_ && request_->ends_with_mark) request_.reset();
}

void ItemRegistry::add(const std::string& name) {
  const ImVec2 corner = ImGui::GetItemRectMin();
  const ImVec2 size = ImGui::GetItemRectSize();
  // Scripts click the centre of an item, so the centre decides whether the item is visible.
  const ImVec2 centre{corner.x + 0.5f * size.x, corner.y + 0.5f * size.y};
  const ImVec2 clip_min = ImGui::GetWindowDrawList()->GetClipRectMin();
  const ImVec2 clip_max = ImGui::GetWindowDrawList()->GetClipRectMax();
  // A table row is wider than the column that it was drawn in, so its width is compared with that of the window.
  const float left = ImGui::GetWindowPos().x;
  const bool outside_x = centre.x < left || centre.x >= left + ImGui::GetWindowWidth();
  const bool outside = outside_x || centre.y < clip_min.y || centre.y >= clip_max.y;
  if (ImGui::IsItemVisible() && !outside) {
    placements_[name] = {Vec2(corner.x, corner.y), Vec2(size.x, size.y)};
    if (name == pointed_out_) mark(corner, size);
    return;
  }
  if (!is_requested(name) && name != scroll_target_ && name != pointed_out_) return;
  ImGui::SetScrollHereY();
  if (outside_x) ImGui::SetScrollHereX();
}

const Placement* ItemRegistry::find(const std::string& name) const {
  const auto found = placements_.find(name);
  return found == placements_.end() ? nullptr : &found->second;
}

void ItemRegistry::request(const std::string& name, const std::string& value) {
  request_ = Request{.name = name, .value = value};
  answer_.reset();
}

std::optional<std::string> ItemRegistry::take_request(const std::string& name) {
  if (!is_requested(name) || answer_) return std::nullopt;
  std::string value = std::move(request_->value);
  request_.reset();
  return value;
}

std::optional<std::string> ItemRegistry::take_answer() { return std::exchange(answer_, std::nullopt); }

}  // namespace etendue::viewer
