// A phase function from a table: linear between values at equidistant cosines.
#pragma once
#include <vector>

#include "medium/phase_function_info.h"
#include "medium/phase_functions/phase_math.h"

namespace etendue {

// Reads two to 1024 numbers that are not negative and not all zero, separated by spaces; an error names the first
// invalid one.
Result<std::vector<double>> parse_phase_table(std::string_view text);

struct TabulatedPhase {
  static constexpr PhaseFunctionDescription kDescription{
      .name = "tabulated",
      .label = "Tabulated",
      .summary = "Measured or computed values, linear in the cosine between them.",
      .formula = "p is proportional to the values at equidistant x from -1 to 1, scaled to integrate to 1",
      .mean_cosine = "Exact integral of the linear pieces.",
      .sampling = "Exact: a piece by its integral, then the root of a quadratic equation.",
      .limitations = "Narrow peaks need many values.",
      .source = "",
  };

  Text values{"values",
              "Values",
              "0.6 0.4 0.4 0.6 2",
              "Relative values at equidistant cosines, from backward (-1) to forward (1), separated by spaces",
              [](std::string_view text) -> Result<void> {
                auto table = parse_phase_table(text);
                return table ? Result<void>() : Result<void>(table.error());
              },
              {{"0.6 0.4 0.4 0.6 2", "Forward"}, {"1 1", "Isotropic"}, {"2 1 2", "Forward and backward"}}};

  auto parameters() { return std::tie(values); }
  void prepare();

  double eval(double x) const;
  double sample(double u) const;
  double mean_cosine() const;

 private:
  // At equidistant cosines: p in 1/sr, and the distribution function.
  std::vector<double> densities_, cumulative_;
};

}  // namespace etendue
