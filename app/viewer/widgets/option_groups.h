// The order of the options of a choice in its list: integrators and reflection models are sorted by group.
#pragma once
#include <string>
#include <vector>

#include "base/parameter.h"

namespace etendue::viewer {

// How an option is shown in a list.
struct ListedOption {
  size_t index = 0;             // in ParameterInfo::options
  const char* group = nullptr;  // its label; null: the option has no group
  const char* group_tooltip = "";
  const char* tooltip = "";
};

// The options in their order, but those of a group together, where its first one is.
std::vector<ListedOption> options_by_group(const ParameterInfo& info);

}  // namespace etendue::viewer
