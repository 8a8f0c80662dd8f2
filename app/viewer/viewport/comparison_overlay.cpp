// Which picture is which, and how far are they apart here? What lies over two pictures that are compared.
#include <imgui.h>

#include <cmath>

#include "spectrum/colormap.h"
#include "viewer/layout/interface.h"
#include "viewer/widgets/format.h"
#include "viewer/widgets/scale_bar.h"

namespace etendue::viewer {
namespace {

bool splits(const Workbench& w) {
  const Comparison& c = w.comparison;
  return c.mode == CompareMode::wipe && c.active() && !c.reference_on_screen() && !w.shows_layer();
}

void divider_line(const Workbench& w, ImDrawList* draw) {
  const Placement& p = w.view.picture;
  const float em = ImGui::GetFontSize(), x = divider_x(w), top = p.corner.y, bottom = top + p.size.y;
  const float middle = top + p.size.y * 0.5f, radius = em * 0.75f, arrow = em * 0.3f;
  const float unit = em / 14;
  const ImU32 dark = IM_COL32(0, 0, 0, 170), light = IM_COL32(255, 255, 255, 235);
  draw->AddLine({x, top}, {x, bottom}, dark, 3.5f * unit);
  draw->AddLine({x, top}, {x, bottom}, light, 1.5f * unit);
  draw->AddCircleFilled({x, middle}, radius, dark);
  for (const float side : {-1.0f, 1.0f}) {
    const float foot = x + side * em * 0.14f;
    draw->AddTriangleFilled({foot, middle - arrow}, {foot, middle + arrow}, {foot + side * arrow * 1.2f, middle},
                            light);
  }
}

// Each name stays on its own side of the divider, and is cut off where that is too narrow.
void side_names(const Workbench& w, ImDrawList* draw) {
  const Comparison& c = w.comparison;
  const Placement& p = w.view.picture;
  const float em = ImGui::GetFontSize(), x = divider_x(w), y = p.corner.y + em * 0.6f, gap = em * 0.5f;
  const std::string left = std::string(c.left_letter()) + "  " + c.left().name,
                    right = std::string(c.right_letter()) + "  " + c.right().name;
  const float bottom = p.corner.y + p.size.y;
  draw->PushClipRect({p.corner.x, p.corner.y}, {x - 2, bottom}, true);
  draw_label(draw, {std::max(p.corner.x + gap, x - gap - label_size(left).x), y}, left);
  draw->PopClipRect();
  draw->PushClipRect({x + 2, p.corner.y}, {p.corner.x + p.size.x, bottom}, true);
  draw_label(draw, {x + gap, y}, right);
  draw->PopClipRect();
}

void label_in_corner(const Workbench& w, ImDrawList* draw, const std::vector<std::string>& lines) {
  const float em = ImGui::GetFontSize();
  Vec2 at = w.view.picture.corner + Vec2(em * 0.6f);
  for (const std::string& line : lines) at.y += draw_label(draw, at, line).y + 1;
}

void map_words(const Workbench& w, ImDrawList* draw) {
  const Comparison& c = w.comparison;
  const auto map = c.map();
  const bool flip = c.mode == CompareMode::flip;
  const std::string sides = flip ? "FLIP" : std::string(c.left_letter()) + " \u2212 " + c.right_letter();
  const std::string head = !map   ? sides + " is being made"
                           : flip ? text_of("FLIP, mean %.4f", map->mean)
                                  : sides + text_of(", mean %+.3g", map->mean);
  label_in_corner(w, draw,
                  {head, std::string(c.left_letter()) + "  " + c.left().name,
                   std::string(c.right_letter()) + "  " + c.right().name});
  if (!map) return;
  if (flip) {
    const std::string figures[] = {"0", "0.25", "0.5", "0.75", "1"};
    draw_scale_bar(w, draw, viridis, figures, "FLIP");
  } else if (map->scale > 0) {
    std::string figures[5];
    for (size_t i = 0; i < 5; ++i)
      figures[i] = i == 2 ? "0" : text_of("%+.3g", static_cast<double>(map->scale) * (static_cast<double>(i) / 2 - 1));
    draw_scale_bar(
        w, draw, [](float x) { return signed_colors(2 * x - 1); }, figures, "luminance, W/(m\u00b2 sr)");
  }
}

std::optional<Vec2i> pixel_under(const Workbench& w, const Side& side) {
  const Placement& p = w.view.picture;
  if (ImGui::GetIO().WantCaptureMouse || !p.contains(w.input.mouse)) return std::nullopt;
  return pixel_at(p, {side.frame->width, side.frame->height}, w.input.mouse);
}

// What both have in the pixel under the pointer.
void read_out(const Workbench& w, ImDrawList* draw) {
  const Comparison& c = w.comparison;
  const auto pixel = pixel_under(w, c.left());
  if (!pixel) return;
  const size_t index =
      static_cast<size_t>(pixel->y) * static_cast<size_t>(c.left().frame->width) + static_cast<size_t>(pixel->x);
  const auto line = [](const std::string& name, const Rgb& v) {
    return name + text_of("%10.4g %10.4g %10.4g", static_cast<double>(v.r), static_cast<double>(v.g),
                          static_cast<double>(v.b));
  };
  const Rgb left = (*c.left().frame->pixels)[index], right = (*c.right().frame->pixels)[index];
  std::string text = text_of("pixel %d, %d\n", pixel->x, pixel->y);
  text += line(std::string(c.left_letter()) + "    ", left) + "\n" +
          line(std::string(c.right_letter()) + "    ", right) + "\n";
  text += line(std::string(c.left_letter()) + " \u2212 " + c.right_letter(), left - right);
  if (const auto map = c.map())
    text += text_of(c.mode == CompareMode::flip ? "\nFLIP %10.4f" : "\nlum. %10.4g",
                    static_cast<double>(map->values[index]));
  const Placement& p = w.view.picture;
  ImGui::PushFont(w.faces.figures);
  const float em = ImGui::GetFontSize();
  draw_label(draw, p.corner + p.size - Vec2(em * 0.6f) - label_size(text), text);  // notices come on the left
  ImGui::PopFont();
}

}  // namespace

float divider_x(const Workbench& w) {
  const Placement& p = w.view.picture;
  return p.corner.x + std::round(p.size.x * w.comparison.divider);
}

bool handle_divider(Workbench& w, bool over) {
  static bool held = false;  // one pointer
  const Placement& p = w.view.picture;
  if (!splits(w)) return held = false;
  const float grip = ImGui::GetFontSize() * 0.5f, x = divider_x(w);
  w.items.place("compare.divider", {{x - grip, p.corner.y}, {2 * grip, p.size.y}});
  const bool near = over && p.contains({p.corner.x, w.input.mouse.y}) && std::abs(w.input.mouse.x - x) <= grip;
  const bool taken = near && w.input.pressed[0];
  if (taken) held = true;
  if (held && !w.input.buttons[0]) held = false;
  if (near || held) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (held) w.comparison.divider = std::clamp((w.input.mouse.x - p.corner.x) / p.size.x, 0.0f, 1.0f);
  if (near && ImGui::IsMouseDoubleClicked(0)) w.comparison.divider = 0.5f, held = false;
  return taken || held;
}

void draw_comparison_overlay(Workbench& w, ImDrawList* draw) {
  const Comparison& c = w.comparison;
  if (w.shows_layer()) return;
  if (c.reference_on_screen()) return label_in_corner(w, draw, {"Reference  " + c.reference.name});
  if (c.mode == CompareMode::off) return;
  if (const std::string problem = c.problem(); !problem.empty()) return label_in_corner(w, draw, {problem});
  if (splits(w)) {
    divider_line(w, draw);
    side_names(w, draw);
  } else {
    map_words(w, draw);
  }
  read_out(w, draw);
}

}  // namespace etendue::viewer
