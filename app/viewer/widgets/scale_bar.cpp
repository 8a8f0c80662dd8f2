#include "viewer/widgets/scale_bar.h"

namespace etendue::viewer {
namespace {

// Figures whose upper edge has its middle at `at`; letters of another size would blur.
void centred(const Workbench& w, ImDrawList* draw, Vec2 at, const char* text) {
  ImFont* font = w.faces.figures;
  const float width = font->CalcTextSizeA(font->FontSize, 1e6f, 0, text).x;
  draw->AddText(font, font->FontSize, {at.x - width * 0.5f, at.y}, ImGui::GetColorU32(ImGuiCol_Text), text);
}

void color_bar(ImDrawList* draw, Vec2 corner, Vec2 size, Rgb (*color)(float)) {
  constexpr int kSteps = 64;
  for (int i = 0; i < kSteps; ++i) {
    const Rgb c = color((static_cast<float>(i) + 0.5f) / kSteps);
    const float x = corner.x + size.x * static_cast<float>(i) / kSteps;
    draw->AddRectFilled({x, corner.y}, {x + size.x / kSteps + 1, corner.y + size.y},
                        ImGui::GetColorU32({c.r, c.g, c.b, 1}));
  }
}

// A ground that words are legible on, with an edge that stands out from a picture of its colour.
void ground(ImDrawList* draw, Vec2 corner, Vec2 end) {
  draw->AddRectFilled({corner.x, corner.y}, {end.x, end.y}, ImGui::GetColorU32(ImGuiCol_PopupBg, 0.92f), 4);
  draw->AddRect({corner.x, corner.y}, {end.x, end.y}, ImGui::GetColorU32(ImGuiCol_Border), 4);
}

Vec2 label_padding() { return Vec2(0.5f, 0.3f) * ImGui::GetFontSize(); }

}  // namespace

void draw_scale_bar(const Workbench& w, ImDrawList* draw, Rgb (*color)(float), std::span<const std::string> figures,
                    const char* title) {
  const float em = ImGui::GetFontSize();
  const float margin = em * 2;  // half of the widest figure stands out at both ends
  const Placement& p = w.view.picture;
  const Vec2 size(em * 16, em * 0.8f);
  const Vec2 corner(p.corner.x + p.size.x - size.x - margin - em * 0.5f, p.corner.y + em * 1.2f);
  ground(draw, corner - Vec2(margin, em * 0.6f), corner + size + Vec2(margin, em * 3.3f));
  color_bar(draw, corner, size, color);
  for (size_t i = 0; i < figures.size(); ++i) {
    const float at = static_cast<float>(i) / static_cast<float>(figures.size() - 1);
    centred(w, draw, {corner.x + size.x * at, corner.y + size.y + em * 0.4f}, figures[i].c_str());
  }
  centred(w, draw, {corner.x + size.x * 0.5f, corner.y + size.y + em * 1.8f}, title);
}

Vec2 label_size(const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  return Vec2(size.x, size.y) + 2.0f * label_padding();
}

Vec2 draw_label(ImDrawList* draw, Vec2 corner, const std::string& text) {
  const Vec2 size = label_size(text), at = corner + label_padding();
  ground(draw, corner, corner + size);
  draw->AddText({at.x, at.y}, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
  return size;
}

}  // namespace etendue::viewer
