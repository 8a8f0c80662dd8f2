#include "viewer/platform/theme.h"

#include <imgui_freetype.h>

#include <array>
#include <filesystem>

namespace etendue::viewer {
namespace {

ImVec4 hex(unsigned rgb, float alpha = 1) {
  const auto part = [&](unsigned shift) { return static_cast<float>((rgb >> shift) & 0xff) / 255.0f; };
  return {part(16), part(8), part(0), alpha};
}

struct Palette {
  unsigned ground, panel, field, field_hover, field_active, text, quiet, border, accent, accent_ground, grab, warning;
};

constexpr Palette kDark{0x16181b, 0x1e2125, 0x2b3036, 0x363d45, 0x424b55, 0xe4e7ea,
                        0xa9b1ba, 0x353b42, 0x6cb6e8, 0x2a5574, 0x34678e, 0xe8b04a};
constexpr Palette kLight{0xd9dcdf, 0xf3f4f5, 0xffffff, 0xe6eef5, 0xd3e3f0, 0x1c1f23,
                         0x4d555e, 0xbfc5cb, 0x0b5c94, 0xb9d9ef, 0x9fcbe9, 0x8a5200};

ImFont* first_of(std::initializer_list<const char*> files, float pixels) {
  static const ImWchar kRanges[] = {0x0020, 0x024f, 0x0370, 0x03ff, 0x2010, 0x2027, 0x2190,
                                    0x21ff, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0};
  ImGuiIO& io = ImGui::GetIO();
  for (const char* file : files) {
    std::error_code code;
    if (!std::filesystem::is_regular_file(file, code)) continue;
    ImFontConfig config;
    config.FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
    if (ImFont* font = io.Fonts->AddFontFromFileTTF(file, pixels, &config, kRanges)) return font;
  }
  ImFontConfig config;
  config.SizePixels = pixels;
  return io.Fonts->AddFontDefault(&config);
}

}  // namespace

Theme apply_theme(bool dark, float scale) {
  const Palette& p = dark ? kDark : kLight;
  ImGuiStyle style;
  style.WindowPadding = {12, 10};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.IndentSpacing = 16;
  style.ScrollbarSize = 12;
  style.GrabMinSize = 10;
  style.WindowRounding = 0;
  style.ChildRounding = 0;
  style.PopupRounding = 5;
  style.FrameRounding = style.GrabRounding = style.TabRounding = style.ScrollbarRounding = 4;
  style.WindowBorderSize = 0;
  style.FrameBorderSize = dark ? 0.0f : 1.0f;
  style.PopupBorderSize = 1;
  style.ScaleAllSizes(scale);

  ImVec4* c = style.Colors;
  if (dark)
    ImGui::StyleColorsDark(&style);
  else
    ImGui::StyleColorsLight(&style);
  c[ImGuiCol_Text] = hex(p.text);
  c[ImGuiCol_TextDisabled] = hex(p.quiet);
  c[ImGuiCol_WindowBg] = hex(p.panel);
  c[ImGuiCol_ChildBg] = hex(p.panel, 0);  // what they lie on has been painted
  c[ImGuiCol_PopupBg] = hex(p.panel);
  c[ImGuiCol_MenuBarBg] = hex(p.ground);
  c[ImGuiCol_Border] = c[ImGuiCol_Separator] = hex(p.border);
  c[ImGuiCol_FrameBg] = hex(p.field);
  c[ImGuiCol_FrameBgHovered] = c[ImGuiCol_ButtonHovered] = c[ImGuiCol_HeaderHovered] = hex(p.field_hover);
  c[ImGuiCol_FrameBgActive] = c[ImGuiCol_ButtonActive] = c[ImGuiCol_HeaderActive] = hex(p.field_active);
  c[ImGuiCol_Button] = hex(p.field);
  c[ImGuiCol_Header] = hex(p.accent_ground);
  c[ImGuiCol_CheckMark] = hex(p.accent);
  c[ImGuiCol_SliderGrab] = c[ImGuiCol_SliderGrabActive] = hex(p.grab);  // figures are read on it
  c[ImGuiCol_Tab] = hex(p.panel);
  c[ImGuiCol_TabHovered] = hex(p.field_hover);
  c[ImGuiCol_TabActive] = hex(p.accent_ground);
  c[ImGuiCol_PlotHistogram] = hex(p.accent);
  c[ImGuiCol_TextSelectedBg] = hex(p.accent, 0.35f);
  c[ImGuiCol_NavHighlight] = c[ImGuiCol_SeparatorActive] = c[ImGuiCol_SeparatorHovered] = hex(p.accent);
  c[ImGuiCol_ScrollbarBg] = hex(p.panel, 0);
  ImGui::GetStyle() = style;
  return {dark, hex(p.ground), hex(p.panel), hex(p.text), hex(p.quiet), hex(p.accent), hex(p.warning)};
}

Faces load_faces(float scale) {
  ImGui::GetIO().Fonts->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  Faces faces;
  faces.text =
      first_of({"/usr/share/fonts/opentype/inter/Inter-Regular.otf",
                "/usr/share/fonts/truetype/inter/Inter-Regular.ttf", "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"},
               16 * scale);
  const auto tabular = {"/usr/share/fonts/truetype/jetbrains-mono/JetBrainsMono-Regular.ttf",
                        "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf"};
  faces.figures = first_of(tabular, 16 * scale);
  faces.small = first_of(tabular, 13 * scale);
  return faces;
}

}  // namespace etendue::viewer
