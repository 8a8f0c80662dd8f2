#include "integration/looks/bitmap_font.h"

#include <array>
#include <cctype>
#include <string_view>

namespace etendue::looks {
namespace {

// One octal digit per row of three pixels, from the top.
constexpr std::string_view kCharacters = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ-_/.:=+,()%";
constexpr std::array<uint16_t, kCharacters.size()> kGlyphs{
    075557, 026227, 071747, 071717, 055711, 074717, 074757, 071111, 075757, 075717,          // digits
    025755, 065656, 034443, 065556, 074647, 074644, 034553, 055755, 072227, 011152, 055655,  // A to K
    044447, 057755, 065555, 025552, 065644, 025563, 065655, 034216, 072222, 055557, 055552,  // L to V
    055775, 055255, 055222, 071247,                                                          // W to Z
    000700, 000007, 011244, 000002, 002020, 007070, 002720, 000024, 012221, 042224, 051245};

}  // namespace

uint16_t bitmap_glyph(char c) {
  const size_t index = kCharacters.find(static_cast<char>(std::toupper(static_cast<unsigned char>(c))));
  return index == std::string_view::npos ? 0 : kGlyphs[index];
}

}  // namespace etendue::looks
