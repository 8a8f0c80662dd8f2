// Letters of three by five pixels, for pictures that must say what they show where there is no font.
#pragma once
#include <cstdint>

namespace etendue::image {

inline constexpr int kGlyphWidth = 3, kGlyphHeight = 5, kGlyphAdvance = kGlyphWidth + 1;

// Fifteen bits, row by row from the upper left one, which is the highest. Small letters look like capitals; what is
// neither a letter of ASCII, a digit nor one of -_/.:=+,()% is empty.
uint16_t bitmap_glyph(char c);

}  // namespace etendue::image
