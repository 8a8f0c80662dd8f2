// The JSON form of structural edits, in the states of documents.
#pragma once
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/structural_edit.h"

namespace etendue::render {

// Changes the name of a file when an edit is written or read.
using FileNaming = std::function<std::string(const std::string& file)>;

nlohmann::json structure_json(const std::vector<scene::StructuralEdit>& edits, const FileNaming& naming);
// The error describes the first edit that cannot be read. Textures have no images yet.
Result<std::vector<scene::StructuralEdit>> structure_from_json(const nlohmann::json& edits, const FileNaming& naming);

}  // namespace etendue::render
