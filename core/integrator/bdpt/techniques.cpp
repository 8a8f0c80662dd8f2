#include "integrator/bdpt/techniques.h"

#include <charconv>
#include <optional>
#include <string>

namespace etendue::integrator {
namespace {

constexpr int kMaxVertices = 1000;

std::optional<int> number_of(std::string_view text, int any) {
  if (text == "*") return any;
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return whole && value >= 0 && value <= kMaxVertices ? std::optional(value) : std::nullopt;
}

}  // namespace

Result<Techniques> Techniques::parse(std::string_view text) {
  Techniques set;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    if (word.empty()) continue;
    const size_t comma = word.find(',');
    const auto s = number_of(word.substr(0, comma), kAny);
    const auto t = comma == word.npos ? std::nullopt : number_of(word.substr(comma + 1), kAny);
    if (!s || !t)
      return usage_error(
          "'" + std::string(word) +
          "' is not a technique: write s,t, the numbers of vertices from the light and from the camera, or * for any: "
          "'0,3', '1,*'");
    set.pairs_.push_back({*s, *t});
  }
  return set;
}

}  // namespace etendue::integrator
