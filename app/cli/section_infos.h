// The parameters of document sections as a list for readers: `etendue list` and the manual.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "render/document.h"

namespace etendue::cli {

// A document with one default material and one light of this type, whose sections can be enumerated.
render::Document sample_document(std::string_view light_type = "point");

// The parameters of a section, with unqualified names.
std::vector<ParameterInfo> section_infos(const render::Document& document, const std::string& section);

}  // namespace etendue::cli
