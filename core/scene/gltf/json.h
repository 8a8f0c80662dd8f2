// The JSON of a glTF file: parsed with bounds, and checked for what tinygltf would silently misread.       glTF 2.0,
// section 5
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace etendue::scene::gltf {

// Parses the text. Throws Unusable where it is no JSON object or is nested too deeply.
nlohmann::json parse_json(std::string_view text, std::vector<std::string>& warnings);

// Version 2, and no required extension that the importer does not know. Throws Unusable.
void check_asset(const nlohmann::json& root);

// Numbers where numbers have to be, of the right count, in a range that the parser's types hold; members that have to
// be there. Indices of primitives are checked later, as they may be compressed. Drops what the importer does not read:
// extras, and extensions that are not supported. Integers written as 3.0 become integers. Throws Unusable.
void check_structure(nlohmann::json& root);

// The parser follows the indices of primitives into their views: they have to have some. Throws Unusable.
void check_index_accessors(const nlohmann::json& root);

}  // namespace etendue::scene::gltf
