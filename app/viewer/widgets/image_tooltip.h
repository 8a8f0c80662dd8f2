// Tooltips that show a small image larger.
#pragma once
#include <imgui.h>

#include <string>

namespace etendue::viewer {

struct ThumbnailImage;
struct UiContext;

// Shows the image above a text if the pointer has not moved for kTooltipDelay; without a texture, the text alone. To be
// called while an item is hovered.
void image_tooltip(const UiContext& ui, ImTextureID texture, const ThumbnailImage& image, const std::string& text);

}  // namespace etendue::viewer
