// Settings from the command line into a document. Empty text changes nothing.
#pragma once
#include <string>
#include <vector>

#include "render/document.h"

namespace etendue::cli {

Result<void> set(render::Document& document, const std::string& name, const std::string& value);
Result<void> set_size(render::Document& document, const std::string& size);  // "1280x720"
Result<void> set_environment(render::Document& document, const std::string& file);
Result<void> set_all(render::Document& document, const std::vector<std::string>& assignments);  // "name=value"

}  // namespace etendue::cli
