// Base64 encoding of bytes [RFC 4648, sec. 4 and 5], for data URIs and attributes of image files.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace etendue {

// The encoded text, padded with '='; no line breaks.
std::string base64(std::span<const std::byte> bytes);

// The bytes of a text in the standard or the URL-safe alphabet, with or without padding; nothing if it is malformed.
std::optional<std::vector<std::byte>> decode_base64(std::string_view text);

}  // namespace etendue
