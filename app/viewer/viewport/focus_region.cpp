#include "viewer/viewport/focus_region.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "render/session.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr float kMinDrag = 4;     // window pixels
constexpr float kNoteWidth = 24;  // of a note, times the font size
constexpr ImGuiWindowFlags kLabelWindow = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                                          ImGuiWindowFlags_NoFocusOnAppearing;

Placement rectangle_on_screen(const AppState& state, const Placement& relative) {
  const Placement& image = state.viewport.image;
  return {image.corner + relative.corner * image.size, relative.size * image.size};
}

void draw_rectangle(const Placement& rectangle) {
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  const float unit = ImGui::GetFontSize() / 14;
  const Vec2 end = rectangle.corner + rectangle.size;
  const auto outline = [&](ImU32 color, float width) {
    draw->AddRect({rectangle.corner.x, rectangle.corner.y}, {end.x, end.y}, color, 0, 0, width);
  };
  outline(IM_COL32(0, 0, 0, 170), 3.5f * unit);
  outline(IM_COL32(255, 210, 60, 255), 1.5f * unit);
}

std::string label_text(const render::Status& status) {
  const std::string measure = film::measure_label(status.measure);
  if (!status.focus) return "Region: " + measure + " ?";
  const film::MeasuredError& error = status.focus->error;
  return "Region: " + measure + " " + (error.known ? film::error_text(status.measure, error.value) : "?") +
         formatted(", %u spp", status.focus->samples);
}

// Above the rectangle, below it, or at its upper edge, where there is space in the viewport.
Vec2 label_corner(const Placement& viewport, const Placement& rectangle, Vec2 size) {
  const float gap = 4;
  const float above = rectangle.corner.y - size.y - gap, below = rectangle.corner.y + rectangle.size.y + gap;
  const float last_x = viewport.corner.x + viewport.size.x - size.x,
              last_y = viewport.corner.y + viewport.size.y - size.y;
  const float y = above >= viewport.corner.y ? above : below <= last_y ? below : rectangle.corner.y + gap;
  return {std::clamp(rectangle.corner.x, viewport.corner.x, std::max(viewport.corner.x, last_x)),
          std::clamp(y, viewport.corner.y, std::max(viewport.corner.y, last_y))};
}

void draw_label_window(AppState& state, const Placement& rectangle) {
  const render::Status status = state.session->status();
  // The size is that of the last frame, so the label appears at its place from the second frame on.
  static constexpr const char* kName = "##region of interest";
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin(kName, nullptr, kLabelWindow);
  const ImVec2 size = ImGui::GetWindowSize();
  const Vec2 corner = label_corner(state.viewport.region, rectangle, {size.x, size.y});
  ImGui::SetWindowPos({std::floor(corner.x), std::floor(corner.y)});
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label_text(status).c_str());
  if (ImGui::IsItemHovered())
    tooltip(state.ui, "Error and samples per pixel of the region, which receives all samples. Limits refer to it");
  ImGui::SameLine();
  action_button(state, "view.clear-region");
  if (status.focus && !status.focus->incompatibility.empty()) {
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * kNoteWidth);
    warning(state.ui,
            "The whole image is sampled. " + with_labels(state.document(), status.focus->incompatibility).text + ".");
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
}

}  // namespace

void FocusRegion::drag(const AppState& state, Vec2 from, Vec2 to) {
  const Placement& image = state.viewport.image;
  const auto relative = [&](Vec2 position) {
    return glm::clamp((position - image.corner) / image.size, Vec2(0), Vec2(1));
  };
  const Vec2 a = relative(from), b = relative(to);
  dragged_ = Placement{glm::min(a, b), glm::abs(b - a)};
  const Vec2 shown = dragged_->size * image.size;
  if (shown.x < kMinDrag || shown.y < kMinDrag) dragged_.reset();
}

void FocusRegion::end_drag() {
  if (dragged_) region_ = dragged_;
  dragged_.reset();
  is_selecting_ = false;
}

std::optional<render::PixelRect> FocusRegion::pixels(Vec2i image_size) const {
  if (!region_) return std::nullopt;
  const Vec2 size(image_size);
  const auto first = glm::clamp(Vec2i(glm::floor(region_->corner * size)), Vec2i(0), image_size - 1);
  const auto end = glm::clamp(Vec2i(glm::ceil((region_->corner + region_->size) * size)), first + 1, image_size);
  return render::PixelRect{first.x, first.y, end.x - first.x, end.y - first.y};
}

void FocusRegion::update(const AppState& state) const {
  state.session->set_focus(pixels({state.document().width, state.document().height}));
}

void FocusRegion::draw(AppState& state) const {
  const auto& shown = dragged_ ? dragged_ : region_;
  if (!shown) return;
  const Placement rectangle = rectangle_on_screen(state, *shown);
  draw_rectangle(rectangle);
  if (!dragged_ && state.interface.visible) draw_label_window(state, intersection(rectangle, state.viewport.region));
}

void toggle_focus_region(AppState& state) {
  FocusRegion& focus = state.viewport.focus;
  const bool begins = !focus.exists() && !focus.is_selecting();
  focus.clear();
  if (!begins) return;
  state.viewport.click_tool.reset();
  focus.begin_selection();
  state.notices.add_message("Drag a rectangle in the image. It receives all samples.");
}

}  // namespace etendue::viewer
