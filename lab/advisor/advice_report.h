// Path class table and ranking as JSON and as text.
#pragma once
#include <string>

#include "advisor/advisor.h"

namespace etendue::advisor {

// {"scene","target","table":{...},"methods":[...],"beyond_all_methods":[...]}; unknown values are null.
std::string ranking_json(const Ranking& ranking, const std::string& scene);

std::string ranking_text(const Ranking& ranking);

}  // namespace etendue::advisor
