// Figures as words, in the lengths that bars and sheets have room for.
#pragma once
#include <cstdio>
#include <string>

namespace etendue::viewer {

// As printf has it, up to 250 letters.
std::string text_of(const char* format, auto... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

// "0:48", "1:02:03".
std::string time_text(double seconds);
// "312 kB", "1.4 GB".
std::string memory_text(size_t bytes);

}  // namespace etendue::viewer
