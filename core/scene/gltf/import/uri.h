// URIs of buffers and images: data URIs and percent-encoded relative paths.  glTF 2.0, section 2.8; RFC 2397; RFC 3986
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace etendue::scene::gltf {

bool is_data_uri(std::string_view uri);

// The bytes of a data URI; nothing if it is malformed.
std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri);

// The local file that a relative URI names; nothing for other URIs ("https://...").
std::optional<std::filesystem::path> file_of_uri(const std::filesystem::path& folder, std::string_view uri);

// A form for messages: long URIs are cut, data URIs show their media type only.
std::string shown_uri(std::string_view uri);

}  // namespace etendue::scene::gltf
