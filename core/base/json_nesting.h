// The nesting of JSON texts, which limits the recursion of functions that read them.
#pragma once
#include <algorithm>
#include <string_view>

namespace etendue {

// The largest number of arrays and objects that are open at once. The text need not be valid JSON. The parse callback of
// nlohmann::json also knows the depth, but its time grows with the square of the length of an array.
constexpr int json_nesting(std::string_view text) {
  int depth = 0, most = 0;
  bool in_string = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
      continue;
    }
    if (c == '"') in_string = true;
    if (c == '[' || c == '{') most = std::max(most, ++depth);
    if (c == ']' || c == '}') --depth;
  }
  return most;
}

}  // namespace etendue
