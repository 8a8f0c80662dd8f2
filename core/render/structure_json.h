// The JSON form of edits that add, remove and rename objects, in the states of documents.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "base/result.h"
#include "scene/structural_edit.h"

namespace etendue::render {

nlohmann::json structure_json(const std::vector<scene::StructuralEdit>& edits);
// The error describes the first edit that cannot be read.
Result<std::vector<scene::StructuralEdit>> structure_from_json(const nlohmann::json& edits);

}  // namespace etendue::render
