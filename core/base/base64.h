// Bytes as text (RFC 4648), as data URIs hold them.
#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace etendue {

std::string base64(std::span<const std::byte> bytes);

}  // namespace etendue
