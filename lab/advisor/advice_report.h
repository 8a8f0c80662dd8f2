// Path class table and ranking as JSON and as text.
#pragma once
#include <limits>
#include <string>

#include "advisor/advisor.h"

namespace etendue::advisor {

// {"scene","target","table":{...},"methods":[...],"beyond_all_methods":[...]}; unknown values are null.
std::string ranking_json(const Ranking& ranking, const std::string& scene);

// The path classes and a line per method. Lists the first `count` methods and the numbers of those that follow.
std::string ranking_text(const Ranking& ranking, size_t count = std::numeric_limits<size_t>::max());

}  // namespace etendue::advisor
