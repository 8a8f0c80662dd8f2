#include "job_part/share.h"

#include <charconv>

namespace etendue::job_part {
namespace {

constexpr uint32_t kMostParts = 1'000'000;

// The number in a text; 0 if it is none.
uint32_t number_in(const std::string& text) {
  uint32_t value = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  return parsed.ec == std::errc() && parsed.ptr == end ? value : 0;
}

}  // namespace

bool is_valid(const Share& share) { return share.part >= 1 && share.part <= share.parts && share.parts <= kMostParts; }

Result<Share> parse_share(const std::string& text) {
  if (const size_t slash = text.find('/'); slash != std::string::npos) {
    const Share share{number_in(text.substr(0, slash)), number_in(text.substr(slash + 1))};
    if (is_valid(share)) return share;
  }
  return usage_error("--part: '" + text + "' is not a part; give K/N with 1 <= K <= N, for example 2/8");
}

std::string text_of(const Share& share) {
  return "part " + std::to_string(share.part) + " of " + std::to_string(share.parts);
}

}  // namespace etendue::job_part
