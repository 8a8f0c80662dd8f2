#include "stress/matrix.h"

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/json_text.h"

namespace etendue::stress {

CaseResult run(const Case& stress_case, const TestOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  TestContext test(options);
  stress_case.run(test);
  return {.stress_case = &stress_case,
          .results = test.take_results(),
          .seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

std::string matrix_json(const std::vector<CaseResult>& rows) {
  auto list = nlohmann::json::array();
  for (const CaseResult& row : rows)
    for (const TestResult& r : row.results) {
      // JSON cannot represent infinity and NaN.
      const nlohmann::json measured = std::isfinite(r.measured) ? nlohmann::json(r.measured) : nlohmann::json();
      list.push_back({{"case", row.stress_case->name},
                      {"kind", kind_name(row.stress_case->kind)},
                      {"method", r.method},
                      {"expectation", r.expectation},
                      {"measured", measured},
                      {"ok", r.ok}});
    }
  return json_text(list, 2);
}

}  // namespace etendue::stress
