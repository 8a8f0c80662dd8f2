#include "scene/gltf/import/uri.h"

#include <cctype>
#include <cstdint>

#include "base/base64.h"
#include "base/provided_files.h"

namespace etendue::scene::gltf {
namespace {

constexpr std::string_view kScheme = "data:";

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const auto lower = static_cast<char>(c | 0x20);
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

// A percent sign without two hexadecimal digits stands for itself: some exporters do not encode file names.
std::string percent_decoded(std::string_view text) {
  std::string decoded;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool escape =
        text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0;
    decoded += escape ? static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2])) : text[i];
    if (escape) i += 2;
  }
  return decoded;
}

// "https:", "file:". A single letter is a drive name instead.
bool has_scheme(std::string_view uri) {
  const size_t colon = uri.find(':');
  if (colon == std::string_view::npos || colon < 2 || !std::isalpha(static_cast<unsigned char>(uri[0]))) return false;
  for (const char c : uri.substr(0, colon))
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '+' && c != '-' && c != '.') return false;
  return true;
}

}  // namespace

bool is_data_uri(std::string_view uri) { return uri.starts_with(kScheme); }

std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri) {
  const size_t comma = uri.find(',');
  if (!is_data_uri(uri) || comma == std::string_view::npos) return std::nullopt;
  const std::string_view head = uri.substr(0, comma), body = uri.substr(comma + 1);
  if (head.ends_with(";base64")) return decode_base64(body);
  const std::string text = percent_decoded(body);
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return std::vector<std::byte>(first, first + text.size());
}

std::optional<std::filesystem::path> file_of_uri(const std::filesystem::path& folder, std::string_view uri) {
  if (uri.empty() || uri.find('\0') != std::string_view::npos) return std::nullopt;
  // If a file with the undecoded name exists, that file is meant.
  const std::filesystem::path literal = folder / std::string(uri);
  if (is_file(literal)) return literal;
  if (has_scheme(uri)) return std::nullopt;
  const std::string decoded = percent_decoded(uri);
  if (decoded.find('\0') != std::string::npos) return std::nullopt;
  return folder / decoded;
}

std::string shown_uri(std::string_view uri) {
  constexpr size_t kLongest = 120;
  if (is_data_uri(uri)) return std::string(uri.substr(0, std::min<size_t>(uri.find_first_of(";,"), 40))) + "...";
  return uri.size() > kLongest ? std::string(uri.substr(0, kLongest)) + "..." : std::string(uri);
}

}  // namespace etendue::scene::gltf
