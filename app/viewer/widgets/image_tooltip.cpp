#include "viewer/widgets/image_tooltip.h"

#include <algorithm>

#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/thumbnail_image.h"
#include "viewer/widgets/ui_context.h"

namespace etendue::viewer {
namespace {

constexpr float kLongerSide = 256;  // units of the interface

}  // namespace

void image_tooltip(const UiContext& ui, ImTextureID texture, const ThumbnailImage& image, const std::string& text) {
  if (!texture) return tooltip(ui, text);
  if (ui.pointer_rest < kTooltipDelay) return;
  const Vec2 pixels(image.width, image.height);
  const Vec2 shown = pixels * (ui.scale * kLongerSide / std::max(pixels.x, pixels.y));
  ImGui::PushFont(ui.fonts.text);
  const float wrap_width = std::max(shown.x, 12 * ImGui::GetFontSize());
  const ImVec2 text_size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap_width);
  place_next_tooltip({std::max(shown.x, text_size.x), shown.y + ImGui::GetStyle().ItemSpacing.y + text_size.y});
  ImGui::BeginTooltip();
  ImGui::Image(texture, {shown.x, shown.y});
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + wrap_width);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopFont();
}

}  // namespace etendue::viewer
