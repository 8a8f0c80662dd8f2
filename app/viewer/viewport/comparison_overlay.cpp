#include "viewer/viewport/comparison_overlay.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "spectrum/colormap.h"
#include "viewer/state/app_state.h"
#include "viewer/viewport/comparison.h"
#include "viewer/viewport/comparison_view.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/scale_bar.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

bool shows_divider(const AppState& state) {
  const Comparison& c = *state.viewport.comparison;
  return c.mode == CompareMode::wipe && c.is_active() && !c.reference_is_shown() && !state.shows_aov();
}

void draw_divider(const AppState& state, ImDrawList* draw) {
  const Placement image = state.viewport.visible_image();
  const float em = ImGui::GetFontSize();
  const float unit = em / 14;
  const float x = divider_x(state);
  const float top = image.corner.y;
  const float bottom = top + image.size.y;
  const float middle = top + image.size.y * 0.5f;
  const float arrow = em * 0.3f;
  const ImU32 dark = IM_COL32(0, 0, 0, 170);
  const ImU32 light = IM_COL32(255, 255, 255, 235);
  draw->AddLine({x, top}, {x, bottom}, dark, 3.5f * unit);
  draw->AddLine({x, top}, {x, bottom}, light, 1.5f * unit);
  draw->AddCircleFilled({x, middle}, em * 0.75f, dark);
  for (const float side : {-1.0f, 1.0f}) {
    const float base = x + side * em * 0.14f;
    draw->AddTriangleFilled({base, middle - arrow}, {base, middle + arrow}, {base + side * arrow * 1.2f, middle},
                            light);
  }
}

std::string left_title(const Comparison& c) { return std::string(c.left_letter()) + "  " + c.left().label; }
std::string right_title(const Comparison& c) { return std::string(c.right_letter()) + "  " + c.right().label; }
std::string difference_title(const Comparison& c) {
  return std::string(c.left_letter()) + " \u2212 " + c.right_letter();
}

// The titles are placed at both sides of the divider. They may extend beyond the image, and are shortened
// where the viewport ends.
void draw_side_titles(const AppState& state, ImDrawList* draw) {
  const Comparison& c = *state.viewport.comparison;
  const Placement image = state.viewport.visible_image();
  const float em = ImGui::GetFontSize();
  const float x = divider_x(state);
  const float y = image.corner.y + em * 0.6f;
  const float gap = em * 0.5f;
  const Placement& region = state.viewport.region;
  const float left_end = region.corner.x;
  const float right_end = region.corner.x + region.size.x;
  const float bottom = image.corner.y + image.size.y;
  const float margins = 2 * gap + label_size("").x;
  const std::string left = shortened(left_title(c), x - left_end - margins);
  const std::string right = shortened(right_title(c), right_end - x - margins);
  draw->PushClipRect({left_end, image.corner.y}, {x - 2, bottom}, true);
  draw_label(draw, {std::max(left_end + gap, x - gap - label_size(left).x), y}, left);
  draw->PopClipRect();
  draw->PushClipRect({x + 2, image.corner.y}, {right_end, bottom}, true);
  draw_label(draw, {x + gap, y}, right);
  draw->PopClipRect();
}

// Labels below each other in the upper left corner of the image.
void draw_corner_labels(const AppState& state, ImDrawList* draw, const std::vector<std::string>& labels) {
  Vec2 corner = state.viewport.visible_image().corner + Vec2(ImGui::GetFontSize() * 0.6f);
  for (const std::string& label : labels) corner.y += draw_label(draw, corner, label).y + 1;
}

void draw_map_labels(const AppState& state, ImDrawList* draw) {
  const Comparison& c = *state.viewport.comparison;
  const bool is_flip = c.mode == CompareMode::flip;
  const auto map = c.map();
  std::string title = is_flip ? "FLIP" : difference_title(c);
  if (!map)
    title += ": computing";
  else
    title += ", " + difference_text(*map);
  draw_corner_labels(state, draw, {title, left_title(c), right_title(c)});
  if (!map) return;
  const UiContext& ui = state.ui;
  const Placement image = state.viewport.visible_image();
  if (is_flip) {
    const std::string labels[] = {"0", "0.25", "0.5", "0.75", "1"};
    draw_scale_bar(ui, draw, image, viridis, labels, "FLIP");
    return;
  }
  if (map->scale <= 0) return;
  std::string labels[5];
  for (size_t i = 0; i < 5; ++i) {
    const double value = static_cast<double>(map->scale) * (static_cast<double>(i) / 2 - 1);
    labels[i] = i == 2 ? "0" : formatted("%+.3g", value);
  }
  const auto color = [](float x) { return diverging_color(2 * x - 1); };
  draw_scale_bar(ui, draw, image, color, labels, "luminance, cd/m\u00b2");
}

// The pixel under the pointer.
std::optional<Vec2i> hovered_pixel(const AppState& state, const Side& side) {
  const Placement& image = state.viewport.image;
  const Vec2 position = state.ui.input.mouse;
  if (ImGui::GetIO().WantCaptureMouse || !image.contains(position)) return std::nullopt;
  return pixel_at(image, {side.frame->width, side.frame->height}, position);
}

std::string radiance_line(const std::string& name, const Rgb& v) {
  return name + formatted("%10.4g %10.4g %10.4g", static_cast<double>(v.r), static_cast<double>(v.g),
                          static_cast<double>(v.b));
}

// The radiance of both images in the pixel under the pointer.
void draw_pixel_values(const AppState& state, ImDrawList* draw) {
  const Comparison& c = *state.viewport.comparison;
  const auto pixel = hovered_pixel(state, c.left());
  if (!pixel) return;
  const auto width = static_cast<size_t>(c.left().frame->width);
  const size_t index = static_cast<size_t>(pixel->y) * width + static_cast<size_t>(pixel->x);
  const Rgb left = (*c.left().frame->pixels)[index];
  const Rgb right = (*c.right().frame->pixels)[index];
  std::string text = formatted("pixel %d, %d\n", pixel->x, pixel->y);
  text += radiance_line(std::string(c.left_letter()) + "    ", left) + "\n";
  text += radiance_line(std::string(c.right_letter()) + "    ", right) + "\n";
  text += radiance_line(difference_title(c), left - right);
  if (const auto map = c.map()) {
    const auto value = static_cast<double>(map->values[index]);
    text += c.mode == CompareMode::flip ? formatted("\nFLIP %10.4f", value) : formatted("\nlum. %10.4g", value);
  }
  // At the right border of the viewport, below titles and scale bars and above the notices at the lower border.
  const Placement& region = state.viewport.region;
  const float em = ImGui::GetFontSize();
  const float top = state.viewport.visible_image().corner.y + 7 * em;
  ImGui::PushFont(state.ui.fonts.monospace);
  draw_label(draw, {region.corner.x + region.size.x - 0.6f * em - label_size(text).x, top}, text);
  ImGui::PopFont();
}

}  // namespace

bool DividerControl::handle_input(AppState& state, bool hovered) {
  if (!shows_divider(state)) {
    held_ = false;
    return false;
  }
  const Placement image = state.viewport.visible_image();
  const Input& input = state.ui.input;
  Comparison& comparison = *state.viewport.comparison;
  const float grip = ImGui::GetFontSize() * 0.5f;
  const float x = divider_x(state);
  state.ui.items.add("compare.divider", Placement{{x - grip, image.corner.y}, {2 * grip, image.size.y}});
  const bool in_image = image.contains({image.corner.x, input.mouse.y});
  const bool near_divider = hovered && in_image && std::abs(input.mouse.x - x) <= grip;
  const bool pressed = near_divider && input.pressed[0];
  if (pressed) held_ = true;
  if (held_ && !input.buttons[0]) held_ = false;
  if (near_divider || held_) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (held_) comparison.divider = std::clamp((input.mouse.x - image.corner.x) / image.size.x, 0.0f, 1.0f);
  if (near_divider && ImGui::IsMouseDoubleClicked(0)) {
    comparison.divider = 0.5f;
    held_ = false;
  }
  return pressed || held_;
}

void draw_comparison_overlay(const AppState& state, ImDrawList* draw) {
  const Comparison& c = *state.viewport.comparison;
  if (state.shows_aov()) return;
  if (c.reference_is_shown()) return draw_corner_labels(state, draw, {"Reference  " + c.reference.label});
  if (c.mode == CompareMode::off) return;
  if (const std::string problem = c.problem(); !problem.empty()) {
    const float width = state.viewport.visible_image().size.x - 1.2f * ImGui::GetFontSize();
    return draw_corner_labels(state, draw, {wrapped_label(problem, width)});
  }
  if (shows_divider(state)) {
    draw_divider(state, draw);
    draw_side_titles(state, draw);
  } else {
    draw_map_labels(state, draw);
  }
  draw_pixel_values(state, draw);
}

}  // namespace etendue::viewer
