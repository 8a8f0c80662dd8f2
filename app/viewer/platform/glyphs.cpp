#include "viewer/platform/glyphs.h"

#include <algorithm>
#include <cstddef>

#include "viewer/widgets/unicode.h"

namespace etendue::viewer {
namespace {

constexpr unsigned kLargest = 0xffff;  // that Dear ImGui shows

bool is_initial(unsigned character) {
  for (size_t i = 0; kInitialGlyphs[i] != 0; i += 2)
    if (character >= kInitialGlyphs[i] && character <= kInitialGlyphs[i + 1]) return true;
  return false;
}

}  // namespace

void GlyphSet::add(std::string_view text) {
  while (!text.empty()) add(take_character(text));
}

void GlyphSet::add(unsigned character) {
  if (character < ' ' || character > kLargest || is_initial(character)) return;
  const auto c = static_cast<unsigned short>(character);
  const auto place = std::ranges::lower_bound(characters_, c);
  if (place != characters_.end() && *place == c) return;
  characters_.insert(place, c);
  changed_ = true;
}

}  // namespace etendue::viewer
