// Base64 encoding of bytes [RFC 4648, sec. 4], for data URIs.
#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace etendue {

// The encoded text, padded with '='; no line breaks.
std::string base64(std::span<const std::byte> bytes);

}  // namespace etendue
