// Names of objects of the scene, and indices in the names of their parameters.
#pragma once
#include <cctype>
#include <optional>
#include <string>
#include <string_view>

namespace etendue::viewer {

// The name of an object; "material 3" if it has none.
inline std::string object_name(const std::string& name, const char* kind, size_t index) {
  return name.empty() ? kind + (" " + std::to_string(index)) : name;
}

// The index 3 of a parameter "material.3.roughness" of a kind "material"; nothing for other parameters.
inline std::optional<int> object_index(const std::string& parameter, std::string_view kind) {
  if (!parameter.starts_with(std::string(kind) + ".")) return std::nullopt;
  const std::string rest = parameter.substr(kind.size() + 1);
  if (rest.empty() || !std::isdigit(static_cast<unsigned char>(rest[0]))) return std::nullopt;
  return std::stoi(rest);
}

}  // namespace etendue::viewer
