// A bitmap font of 3 x 5 pixels, for labels in images where no other font is available.
#pragma once
#include <cstdint>

namespace etendue::looks {

inline constexpr int kGlyphWidth = 3, kGlyphHeight = 5, kGlyphAdvance = kGlyphWidth + 1;

// The 15 pixels of a character, row by row from the top, the upper left pixel in the highest bit. Contains the ASCII
// letters (lower case as upper case), the digits and -_/.:=+,()%; all other characters are empty.
uint16_t bitmap_glyph(char c);

}  // namespace etendue::looks
