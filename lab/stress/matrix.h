// The stability matrix: the results of the cases, as JSON and as an HTML page.
#pragma once
#include <string>
#include <vector>

#include "stress/case.h"

namespace etendue::stress {

struct CaseResult {
  const Case* stress_case;
  std::vector<TestResult> results;
  double seconds = 0;
};

CaseResult run(const Case& stress_case, const TestOptions& options);

// An array of {"case", "kind", "method", "expectation", "measured", "ok"}.
std::string matrix_json(const std::vector<CaseResult>& rows);
// A self-contained page with the theory of each case, all results, and images.
std::string matrix_html(const std::vector<CaseResult>& rows);

}  // namespace etendue::stress
