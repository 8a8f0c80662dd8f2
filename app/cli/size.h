// A size as the command line takes it.
#pragma once
#include <string>

#include "base/result.h"
#include "base/vec.h"

namespace etendue::cli {

// Of "1280x720". What is none, or beyond what an image may have, is a usage error.
Result<Vec2i> parse_size(const std::string& text);

}  // namespace etendue::cli
