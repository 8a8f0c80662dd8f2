// The characters of names and messages that the fonts do not contain from the start. Fonts are loaded again with them:
// rasterising all of Unicode would take longer than the start of the program.
#pragma once
#include <string_view>
#include <utility>
#include <vector>

namespace etendue::viewer {

class GlyphSet {
 public:
  // Adds the characters of a UTF-8 text.
  void add(std::string_view text);
  void add(unsigned character);

  bool has_change() const { return changed_; }
  // Whether characters have been added since the last call.
  bool take_change() { return std::exchange(changed_, false); }
  // In ascending order, without those of kInitialGlyphs.
  const std::vector<unsigned short>& characters() const { return characters_; }

 private:
  std::vector<unsigned short> characters_;
  bool changed_ = false;
};

// The ranges that fonts contain from the start: pairs of the first and the last character, and a 0.
inline constexpr unsigned short kInitialGlyphs[] = {0x0020, 0x024f, 0x0370, 0x03ff, 0x2010, 0x2027, 0x2032, 0x2033,
                                                    0x2190, 0x21ff, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0};

}  // namespace etendue::viewer
