// Sweeps over all elements in order, with a relaxation factor.                        [Lang, eq. 2.514-2.524, corrected]
#pragma once
#include "radiosity/solver.h"

namespace etendue::radiosity {

// B_i <- B_i + factor * r_i with the newest values of all elements. The diagonal of the matrix is 1, because no patch
// sees itself.
inline Solution relax(const RadiositySystem& system, const SolverSettings& settings, double factor) {
  SolverProgress progress(system, settings);
  std::vector<double> b = system.source;
  while (progress.should_continue(b))
    for (size_t i = 0; i < b.size(); ++i) b[i] += factor * system.residual_at(i, b);
  return progress.finish(std::move(b));
}

}  // namespace etendue::radiosity
