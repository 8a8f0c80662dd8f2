// Text as pixels, in the typeface of the charts (FreeType).
#pragma once
#include <functional>
#include <string>

namespace etendue::metrics {

// The typefaces of charts, the first one that is installed; as the value of font-family in CSS.
inline constexpr const char* kTypefaces = "Inter, DejaVu Sans, sans-serif";

// The width in pixels of a text in UTF-8 whose letters have this size; 0 if no typeface is installed.
double text_width(const std::string& text, double size);

// Calls `blend` with position and coverage, 0 to 1, of each pixel of a text that begins at x on the base line y.
void rasterize_text(const std::string& text, double size, double x, double y,
                    const std::function<void(int x, int y, double coverage)>& blend);

}  // namespace etendue::metrics
