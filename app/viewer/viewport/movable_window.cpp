#include "viewer/viewport/movable_window.h"

#include <imgui.h>

namespace etendue::viewer {
namespace {

constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                                    ImGuiWindowFlags_NoFocusOnAppearing;

}  // namespace

Vec2 MovableWindow::clamped(const Placement& region, const Vec2& offset) const {
  return glm::clamp(offset, Vec2(0), glm::max(region.size - placement_.size, Vec2(0)));
}

bool MovableWindow::draw(const char* name, const Placement& region, Vec2& offset, const Vec2& usual_offset,
                         const std::function<void()>& content) {
  const Vec2 shown = clamped(region, offset);
  ImGui::SetNextWindowPos({region.corner.x + region.size.x - shown.x, region.corner.y + shown.y}, ImGuiCond_Always,
                          {1, 0});
  ImGui::SetNextWindowBgAlpha(0.88f);
  ImGui::Begin(name, nullptr, kFlags);
  content();
  const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  placement_ = {{corner.x, corner.y}, {size.x, size.y}};
  if (is_dragged_) offset = shown;
  const bool is_placed = take_drag(offset, usual_offset);
  ImGui::End();
  return is_placed;
}

bool MovableWindow::take_drag(Vec2& offset, const Vec2& usual_offset) {
  const bool is_free = ImGui::IsWindowHovered() && !ImGui::IsAnyItemHovered();
  if (is_free || is_dragged_) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
  if (is_free && ImGui::IsMouseDoubleClicked(0)) {
    offset = usual_offset;
    return true;
  }
  if (is_free && ImGui::IsMouseClicked(0)) is_dragged_ = true;
  if (!is_dragged_) return false;
  const ImVec2 movement = ImGui::GetIO().MouseDelta;
  if (ImGui::IsMouseDown(0)) offset += Vec2(-movement.x, movement.y);
  is_dragged_ = ImGui::IsMouseDown(0);
  return !is_dragged_;
}

}  // namespace etendue::viewer
