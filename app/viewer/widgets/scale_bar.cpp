#include "viewer/widgets/scale_bar.h"

#include <algorithm>

#include "viewer/widgets/ui_context.h"

namespace etendue::viewer {
namespace {

// `position` is the middle of the upper edge.
void draw_centred(const UiContext& ui, ImDrawList* draw, Vec2 position, const char* text) {
  ImFont* font = ui.fonts.monospace;
  const float width = font->CalcTextSizeA(font->FontSize, 1e6f, 0, text).x;
  draw->AddText(font, font->FontSize, {position.x - width * 0.5f, position.y}, ImGui::GetColorU32(ImGuiCol_Text), text);
}

void draw_colors(ImDrawList* draw, Vec2 corner, Vec2 size, Rgb (*color)(float)) {
  constexpr int kSteps = 64;
  for (int i = 0; i < kSteps; ++i) {
    const Rgb c = color((static_cast<float>(i) + 0.5f) / kSteps);
    const float x = corner.x + size.x * static_cast<float>(i) / kSteps;
    draw->AddRectFilled({x, corner.y}, {x + size.x / kSteps + 1, corner.y + size.y},
                        ImGui::GetColorU32({c.r, c.g, c.b, 1}));
  }
}

void draw_background(ImDrawList* draw, Vec2 corner, Vec2 end) {
  constexpr float kRounding = 4;
  draw->AddRectFilled({corner.x, corner.y}, {end.x, end.y}, ImGui::GetColorU32(ImGuiCol_PopupBg, 0.92f), kRounding);
  draw->AddRect({corner.x, corner.y}, {end.x, end.y}, ImGui::GetColorU32(ImGuiCol_Border), kRounding);
}

Vec2 label_padding() { return Vec2(0.5f, 0.3f) * ImGui::GetFontSize(); }

}  // namespace

void draw_scale_bar(const UiContext& ui, ImDrawList* draw, const Placement& image, Rgb (*color)(float),
                    std::span<const std::string> labels, const char* title) {
  const float em = ImGui::GetFontSize();
  const float margin = em * 2;  // for the labels at both ends
  const Vec2 size(em * 16, em * 0.8f);
  const Vec2 corner(image.corner.x + image.size.x - size.x - margin - em * 0.5f, image.corner.y + em * 1.2f);
  draw_background(draw, corner - Vec2(margin, em * 0.6f), corner + size + Vec2(margin, em * 3.3f));
  draw_colors(draw, corner, size, color);
  for (size_t i = 0; i < labels.size(); ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(labels.size() - 1);
    draw_centred(ui, draw, {corner.x + size.x * share, corner.y + size.y + em * 0.4f}, labels[i].c_str());
  }
  draw_centred(ui, draw, {corner.x + size.x * 0.5f, corner.y + size.y + em * 1.8f}, title);
}

Vec2 label_size(const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  return Vec2(size.x, size.y) + 2.0f * label_padding();
}

std::string wrapped_label(const std::string& text, float width) {
  const float room = std::max(width - 2 * label_padding().x, ImGui::GetFontSize());
  std::string wrapped;
  for (const char *line = text.c_str(), *end = line + text.size(); line < end;) {
    const char* next = ImGui::GetFont()->CalcWordWrapPositionA(1, line, end, room);
    if (next == line) ++next;  // not even one character fits
    if (!wrapped.empty()) wrapped += '\n';
    wrapped.append(line, next);
    while (next < end && *next == ' ') ++next;
    line = next;
  }
  return wrapped;
}

Vec2 draw_label(ImDrawList* draw, Vec2 corner, const std::string& text) {
  const Vec2 size = label_size(text);
  const Vec2 text_corner = corner + label_padding();
  draw_background(draw, corner, corner + size);
  draw->AddText({text_corner.x, text_corner.y}, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
  return size;
}

}  // namespace etendue::viewer
