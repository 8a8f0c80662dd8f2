// Former names of items and actions, which scripts may still use.
#pragma once
#include <string>

namespace etendue::viewer {

// The present name of an item or an action; the argument itself if it was never renamed.
std::string current_name(const std::string& name);

}  // namespace etendue::viewer
