#include "viewer/platform/theme.h"

#include <imgui_freetype.h>

#include <array>
#include <cmath>
#include <filesystem>

namespace etendue::viewer {
namespace {

ImVec4 hex(unsigned rgb, float alpha = 1) {
  const auto part = [&](unsigned shift) { return static_cast<float>((rgb >> shift) & 0xff) / 255.0f; };
  return {part(16), part(8), part(0), alpha};
}

// Colours as 0xRRGGBB.
struct Palette {
  unsigned background;
  unsigned panel;
  unsigned field;
  unsigned field_hover;
  unsigned field_active;
  unsigned text;
  unsigned secondary_text;
  unsigned border;
  unsigned accent;
  unsigned selected;
  unsigned grab;
  unsigned warning;
};

constexpr Palette kDark{
    .background = 0x16181b,
    .panel = 0x1e2125,
    .field = 0x2b3036,
    .field_hover = 0x363d45,
    .field_active = 0x424b55,
    .text = 0xe4e7ea,
    .secondary_text = 0xa9b1ba,
    .border = 0x353b42,
    .accent = 0x6cb6e8,
    .selected = 0x2a5574,
    .grab = 0x34678e,
    .warning = 0xe8b04a,
};
constexpr Palette kLight{
    .background = 0xd9dcdf,
    .panel = 0xf3f4f5,
    .field = 0xffffff,
    .field_hover = 0xe6eef5,
    .field_active = 0xd3e3f0,
    .text = 0x1c1f23,
    .secondary_text = 0x4d555e,
    .border = 0xbfc5cb,
    .accent = 0x0b5c94,
    .selected = 0xb9d9ef,
    .grab = 0x9fcbe9,
    .warning = 0x8a5200,
};

// Height of the small font, relative to the others.
constexpr float kSmallFont = 13.0f / 16;

// Loads the first font file that exists; otherwise the font that is built into Dear ImGui.
ImFont* load_first(std::initializer_list<const char*> files, float pixels) {
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
  c[ImGuiCol_TextDisabled] = hex(p.secondary_text);
  c[ImGuiCol_WindowBg] = hex(p.panel);
  c[ImGuiCol_ChildBg] = hex(p.panel, 0);  // transparent: the parent window has a background
  c[ImGuiCol_PopupBg] = hex(p.panel);
  c[ImGuiCol_MenuBarBg] = hex(p.background);
  c[ImGuiCol_Border] = c[ImGuiCol_Separator] = hex(p.border);
  c[ImGuiCol_FrameBg] = hex(p.field);
  c[ImGuiCol_FrameBgHovered] = c[ImGuiCol_ButtonHovered] = c[ImGuiCol_HeaderHovered] = hex(p.field_hover);
  c[ImGuiCol_FrameBgActive] = c[ImGuiCol_ButtonActive] = c[ImGuiCol_HeaderActive] = hex(p.field_active);
  c[ImGuiCol_Button] = hex(p.field);
  c[ImGuiCol_Header] = hex(p.selected);
  c[ImGuiCol_CheckMark] = hex(p.accent);
  c[ImGuiCol_SliderGrab] = c[ImGuiCol_SliderGrabActive] = hex(p.grab);  // numbers are drawn over it
  c[ImGuiCol_Tab] = hex(p.panel);
  c[ImGuiCol_TabHovered] = hex(p.field_hover);
  c[ImGuiCol_TabActive] = hex(p.selected);
  c[ImGuiCol_PlotHistogram] = hex(p.accent);
  c[ImGuiCol_TextSelectedBg] = hex(p.accent, 0.35f);
  c[ImGuiCol_NavHighlight] = c[ImGuiCol_SeparatorActive] = c[ImGuiCol_SeparatorHovered] = hex(p.accent);
  c[ImGuiCol_ScrollbarBg] = hex(p.panel, 0);
  ImGui::GetStyle() = style;
  return {.dark = dark,
          .background = hex(p.background),
          .panel = hex(p.panel),
          .text = hex(p.text),
          .secondary_text = hex(p.secondary_text),
          .accent = hex(p.accent),
          .warning = hex(p.warning)};
}

Fonts load_fonts(float size) {
  ImGui::GetIO().Fonts->Clear();
  ImGui::GetIO().Fonts->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  Fonts fonts;
  fonts.text = load_first(
      {"/usr/share/fonts/opentype/inter/Inter-Regular.otf", "/usr/share/fonts/truetype/inter/Inter-Regular.ttf",
       "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"},
      size);
  const auto monospace = {"/usr/share/fonts/truetype/jetbrains-mono/JetBrainsMono-Regular.ttf",
                          "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf"};
  fonts.monospace = load_first(monospace, size);
  fonts.small = load_first(monospace, std::round(size * kSmallFont));
  return fonts;
}

}  // namespace etendue::viewer
