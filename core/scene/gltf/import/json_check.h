// Parses the JSON of a glTF file with limits, and checks what tinygltf would misread or reject without naming the
// place.                                                                                         glTF 2.0, section 5
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace etendue::scene::gltf {

// Throws FileError if the text is not a JSON object or is nested too deeply.
nlohmann::json parse_json(std::string_view text, std::vector<std::string>& warnings);

// Throws FileError unless the file is glTF 2.0 and requires only extensions that the importer supports.
void check_asset(const nlohmann::json& root);

// Checks the types of members, the lengths of number arrays, the ranges of numbers and the presence of required
// members. Removes what the importer does not read: extras and unsupported extensions. Turns integers that are written
// as 3.0 into integers. Throws FileError. Indices of primitives may be compressed here; check_index_accessors checks
// them.
void check_structure(nlohmann::json& root);

// Throws FileError unless the indices of each primitive are in an accessor with a buffer view: tinygltf follows them.
void check_index_accessors(const nlohmann::json& root);

}  // namespace etendue::scene::gltf
