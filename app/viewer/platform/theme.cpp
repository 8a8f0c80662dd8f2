#include "viewer/platform/theme.h"

#include <imgui_freetype.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <span>
#include <vector>

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
constexpr float kSmallFont = 14.0f / 16;

// Fonts for characters that the fonts of the interface lack: symbols, then Chinese, Japanese and Korean.
constexpr const char* kSymbolFonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"};
constexpr const char* kCjkFonts[] = {"/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
                                     "/usr/share/fonts/truetype/noto/NotoSansCJK-Regular.ttc",
                                     "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf",
                                     "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc",
                                     "/usr/share/fonts/truetype/wqy/wqy-zenhei.ttc",
                                     "/usr/share/fonts/truetype/arphic/uming.ttc",
                                     "/usr/share/fonts/truetype/fonts-japanese-gothic.ttf",
                                     "/usr/share/fonts/truetype/nanum/NanumGothic.ttf",
                                     "/usr/share/fonts/opentype/unifont/unifont.otf"};

// The first font file that exists; null if none does.
const char* first_existing(std::span<const char* const> files) {
  std::error_code code;
  for (const char* file : files)
    if (std::filesystem::is_regular_file(file, code)) return file;
  return nullptr;
}

// Dear ImGui reads the ranges when it builds the atlas, after load_fonts has returned.
struct GlyphRanges {
  std::vector<ImWchar> all, added;
};
const GlyphRanges& keep_ranges(const GlyphSet& glyphs) {
  static GlyphRanges ranges;
  ranges.added.clear();
  for (const unsigned short c : glyphs.characters()) ranges.added.insert(ranges.added.end(), {c, c});
  ranges.added.push_back(0);
  ranges.all.assign(std::begin(kInitialGlyphs), std::end(kInitialGlyphs) - 1);
  ranges.all.insert(ranges.all.end(), ranges.added.begin(), ranges.added.end());
  return ranges;
}

// Loads the first font file that exists; otherwise the font that is built into Dear ImGui.
ImFont* load_first(std::initializer_list<const char*> files, float pixels, const GlyphRanges& ranges) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  ImFontConfig config;
  config.FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
  config.SizePixels = pixels;
  const char* file = first_existing(files);
  ImFont* font = file ? atlas.AddFontFromFileTTF(file, pixels, &config, ranges.all.data()) : nullptr;
  if (!font) font = atlas.AddFontDefault(&config);
  if (ranges.added.size() < 2) return font;
  config.MergeMode = true;
  for (const std::span<const char* const> fallback :
       {std::span<const char* const>(kSymbolFonts), std::span<const char* const>(kCjkFonts)})
    if (const char* other = first_existing(fallback))
      atlas.AddFontFromFileTTF(other, pixels, &config, ranges.added.data());
  return font;
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
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TableHeaderBg] = hex(p.field);
  c[ImGuiCol_TitleBgActive] = hex(p.selected);
  c[ImGuiCol_ModalWindowDimBg] = {0, 0, 0, 0.5f};
  ImGui::GetStyle() = style;
  return {.dark = dark,
          .background = hex(p.background),
          .panel = hex(p.panel),
          .text = hex(p.text),
          .secondary_text = hex(p.secondary_text),
          .accent = hex(p.accent),
          .warning = hex(p.warning)};
}

Fonts load_fonts(float size, const GlyphSet& glyphs) {
  const GlyphRanges& ranges = keep_ranges(glyphs);
  ImGui::GetIO().Fonts->Clear();
  ImGui::GetIO().Fonts->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  Fonts fonts;
  fonts.text = load_first(
      {"/usr/share/fonts/opentype/inter/Inter-Regular.otf", "/usr/share/fonts/truetype/inter/Inter-Regular.ttf",
       "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"},
      size, ranges);
  const auto monospace = {"/usr/share/fonts/truetype/jetbrains-mono/JetBrainsMono-Regular.ttf",
                          "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf"};
  fonts.monospace = load_first(monospace, size, ranges);
  fonts.small = load_first(monospace, std::round(size * kSmallFont), ranges);
  return fonts;
}

size_t count_missing(const ImFont& font, const GlyphSet& glyphs) {
  return static_cast<size_t>(std::ranges::count_if(
      glyphs.characters(), [&](unsigned short c) { return font.FindGlyphNoFallback(c) == nullptr; }));
}

}  // namespace etendue::viewer
