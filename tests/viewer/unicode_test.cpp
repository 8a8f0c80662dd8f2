// Characters of names: decoding, lower case, and the set of characters that fonts are loaded with.
#include "viewer/widgets/unicode.h"

#include <gtest/gtest.h>

#include "viewer/platform/glyphs.h"

namespace etendue::viewer {
namespace {

TEST(Unicode, CharactersAreDecoded) {
  std::string_view text = "a\u00e9\u4e2d\U0001f600";
  EXPECT_EQ(take_character(text), 'a');
  EXPECT_EQ(take_character(text), 0xe9U);
  EXPECT_EQ(take_character(text), 0x4e2dU);
  EXPECT_EQ(take_character(text), 0x1f600U);
  EXPECT_TRUE(text.empty());
}

TEST(Unicode, DamagedTextsAreReadByteByByte) {
  for (const char* damaged : {"\xff", "\xc3", "\xe4\xb8", "\x80", "\xf0\x9f\x98", "\xc0\x80"}) {
    std::string_view text = damaged;
    EXPECT_EQ(take_character(text), 0xfffdU);
    EXPECT_EQ(text.size(), std::string_view(damaged).size() - 1);
    EXPECT_EQ(lower_case(damaged), damaged) << "bytes stay";
  }
}

TEST(Unicode, LowerCaseOfSeveralAlphabets) {
  EXPECT_EQ(lower_case("ABC xyz 0-9 [Z]"), "abc xyz 0-9 [z]");
  EXPECT_EQ(lower_case("\u00c9TENDUE \u00d7 \u00df"), "\u00e9tendue \u00d7 \u00df");
  EXPECT_EQ(lower_case("\u0160\u0141\u0178\u017d"), "\u0161\u0142\u00ff\u017e");
  EXPECT_EQ(lower_case("\u03a3\u039f\u03a6\u038c\u03c2"), "\u03c3\u03bf\u03c6\u03cc\u03c3");
  EXPECT_EQ(lower_case("\u0421\u0426\u0415\u041d\u0410 \u0401"), "\u0441\u0446\u0435\u043d\u0430 \u0451");
  EXPECT_EQ(lower_case("\u4e2d\u6587 \u2764"), "\u4e2d\u6587 \u2764");
  for (unsigned c = 0; c < 0x10000; ++c) EXPECT_EQ(lower_case(lower_case(c)), lower_case(c)) << c;
}

TEST(Unicode, SearchIgnoresCase) {
  EXPECT_TRUE(contains_ignoring_case("\u00c9toile.glb", "\u00e9TOILE"));
  EXPECT_TRUE(contains_ignoring_case("abc", ""));
  EXPECT_FALSE(contains_ignoring_case("\u00c9toile.glb", "etoile"));
}

TEST(Unicode, OnlyNewCharactersChangeTheGlyphSet) {
  GlyphSet glyphs;
  glyphs.add("plain \u00e9 \u03b2 \u2192");
  EXPECT_FALSE(glyphs.take_change());
  glyphs.add("\u2764\u0441\u2764");
  EXPECT_TRUE(glyphs.take_change());
  glyphs.add("\u0441");
  EXPECT_FALSE(glyphs.take_change());
  EXPECT_EQ(glyphs.characters(), (std::vector<unsigned short>{0x441, 0x2764}));
  glyphs.add("\U0001f600\n");
  EXPECT_FALSE(glyphs.take_change()) << "beyond the characters that can be shown";
}

}  // namespace
}  // namespace etendue::viewer
