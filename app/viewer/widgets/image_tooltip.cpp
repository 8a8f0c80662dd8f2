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
  const auto width = static_cast<float>(image.width), height = static_cast<float>(image.height);
  const float scale = ui.scale * kLongerSide / std::max(width, height);
  ImGui::PushFont(ui.fonts.text);
  ImGui::BeginTooltip();
  ImGui::Image(texture, {scale * width, scale * height});
  ImGui::PushTextWrapPos(std::max(scale * width, 12 * ImGui::GetFontSize()));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopFont();
}

}  // namespace etendue::viewer
