// Alternatives in braces, as in shells: "{path,bdpt}:sampler={sobol,random}" stands for four methods.
#pragma once
#include <string>
#include <vector>

#include "base/result.h"

namespace etendue::bench {

inline constexpr size_t kMostAlternatives = 200;

// All texts that a text with alternatives stands for; the last braces vary fastest. Braces do not nest. A usage error if a
// brace has no counterpart, or if there are more than kMostAlternatives texts.
Result<std::vector<std::string>> expand_alternatives(const std::string& text);

}  // namespace etendue::bench
