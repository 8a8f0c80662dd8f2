// The stability matrix: cases, what was found, and how it is shown.
#pragma once
#include <string>
#include <vector>

#include "stress/case.h"

namespace etendue::stress {

struct Row {
  const Case* stress_case;
  std::vector<Finding> findings;
  double seconds = 0;
};

Row run(const Case& stress_case, const LabOptions& options);

// An array of {"case", "kind", "method", "expectation", "measured", "ok"}.
std::string matrix_json(const std::vector<Row>& rows);
// A page that stands alone, with the theory of each case and pictures.
std::string matrix_html(const std::vector<Row>& rows);

}  // namespace etendue::stress
