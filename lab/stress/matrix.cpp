#include "stress/matrix.h"

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

namespace etendue::stress {

Row run(const Case& stress_case, const LabOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  Lab lab(options);
  stress_case.run(lab);
  return {&stress_case, lab.take_findings(),
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

std::string matrix_json(const std::vector<Row>& rows) {
  auto list = nlohmann::json::array();
  for (const Row& row : rows)
    for (const Finding& f : row.findings) {
      // JSON has no infinity.
      const nlohmann::json measured = std::isfinite(f.measured) ? nlohmann::json(f.measured) : nlohmann::json();
      list.push_back({{"case", row.stress_case->name},
                      {"kind", kind_name(row.stress_case->kind)},
                      {"method", f.method},
                      {"expectation", f.expectation},
                      {"measured", measured},
                      {"ok", f.ok}});
    }
  return list.dump(2);
}

}  // namespace etendue::stress
