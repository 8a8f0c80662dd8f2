// The table and the ranking as JSON for scripts and as text for people.
#pragma once
#include <string>

#include "advisor/advisor.h"

namespace etendue::advisor {

// {"scene","target","table":{...},"methods":[...],"beyond_all_methods":[...]}; what is not known is null.
std::string ranking_json(const Ranking& ranking, const std::string& scene);

std::string ranking_text(const Ranking& ranking);

}  // namespace etendue::advisor
