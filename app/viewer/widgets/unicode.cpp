#include "viewer/widgets/unicode.h"

#include <cstddef>

namespace etendue::viewer {
namespace {

constexpr unsigned kInvalid = 0xfffd;

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

void append(std::string& text, unsigned c) {
  const auto put = [&](unsigned byte) { text += static_cast<char>(byte); };
  if (c < 0x80) return put(c);
  if (c < 0x800) {
    put(0xc0 | c >> 6);
  } else {
    if (c < 0x10000) {
      put(0xe0 | c >> 12);
    } else {
      put(0xf0 | c >> 18);
      put(0x80 | (c >> 12 & 0x3f));
    }
    put(0x80 | (c >> 6 & 0x3f));
  }
  put(0x80 | (c & 0x3f));
}

// Letters whose lower case has a constant distance, or alternates with the upper case.
struct CaseRange {
  unsigned first, last;
  unsigned distance;  // 0: each upper case letter, at the parity of `first`, is followed by its lower case
};
constexpr CaseRange kCases[] = {{'A', 'Z', 32},     {0xc0, 0xd6, 32},    {0xd8, 0xde, 32},   {0x100, 0x12f, 0},
                                {0x132, 0x137, 0},  {0x139, 0x148, 0},   {0x14a, 0x177, 0},  {0x179, 0x17e, 0},
                                {0x386, 0x386, 38}, {0x388, 0x38a, 37},  {0x38c, 0x38c, 64}, {0x38e, 0x38f, 63},
                                {0x391, 0x3a1, 32}, {0x3a3, 0x3ab, 32},  {0x400, 0x40f, 80}, {0x410, 0x42f, 32},
                                {0x460, 0x481, 0},  {0x48a, 0x4bf, 0},   {0x4c1, 0x4ce, 0},  {0x4d0, 0x52f, 0},
                                {0x531, 0x556, 48}, {0x1e00, 0x1e95, 0}, {0x1ea0, 0x1eff, 0}};

}  // namespace

unsigned take_character(std::string_view& text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const size_t length = lead < 0x80 ? 1 : lead >= 0xf0 && lead < 0xf8 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc2 ? 2 : 0;
  bool valid = length > 0 && lead < 0xf8 && length <= text.size();
  for (size_t i = 1; valid && i < length; ++i) valid = is_continuation(text[i]);
  unsigned c = kInvalid;
  if (valid) {
    constexpr unsigned kLeadBits[] = {0, 0x7f, 0x1f, 0x0f, 0x07};
    c = lead & kLeadBits[length];
    for (size_t i = 1; i < length; ++i) c = c << 6 | (static_cast<unsigned char>(text[i]) & 0x3f);
  }
  text.remove_prefix(valid ? length : 1);
  return c;
}

unsigned lower_case(unsigned c) {
  constexpr unsigned kCapitalYDiaeresis = 0x178, kFinalSigma = 0x3c2, kSigma = 0x3c3;
  if (c == kCapitalYDiaeresis) return 0xff;
  if (c == kFinalSigma) return kSigma;
  for (const CaseRange& range : kCases) {
    if (c < range.first || c > range.last) continue;
    if (range.distance > 0) return c + range.distance;
    return (c - range.first) % 2 == 0 ? c + 1 : c;
  }
  return c;
}

std::string lower_case(std::string_view text) {
  std::string lower;
  lower.reserve(text.size());
  while (!text.empty()) {
    const char first = text.front();
    const size_t before = text.size();
    const unsigned c = take_character(text);
    if (c == kInvalid && before - text.size() == 1)
      lower += first;
    else
      append(lower, lower_case(c));
  }
  return lower;
}

bool contains_ignoring_case(std::string_view text, std::string_view searched) {
  return searched.empty() || lower_case(text).find(lower_case(searched)) != std::string::npos;
}

}  // namespace etendue::viewer
