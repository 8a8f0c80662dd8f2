// Characters of UTF-8 texts, and searching without regard to case.
#pragma once
#include <string>
#include <string_view>

namespace etendue::viewer {

// The first character, which is removed from the text. A byte that begins no valid sequence is U+FFFD. The text must not
// be empty.
unsigned take_character(std::string_view& text);

// The lower case of a letter in the Latin, Greek, Cyrillic and Armenian alphabets; other characters stay.
unsigned lower_case(unsigned character);

// The same for a UTF-8 text. Bytes that are not valid UTF-8 stay.
std::string lower_case(std::string_view text);

// Whether `text` contains `searched` without regard to case.
bool contains_ignoring_case(std::string_view text, std::string_view searched);

}  // namespace etendue::viewer
