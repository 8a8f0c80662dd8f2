// Successive over-relaxation                                                            [Lang, eq. 2.523, 2.524]
//
//    B_i  <-  (1 - alpha) B_i  +  alpha (Gauss-Seidel update of B_i)
//
// It is Gauss-Seidel iteration for alpha = 1, and diverges for alpha >= 2.
#include "radiosity/solvers/relaxation.h"

namespace etendue::radiosity {
namespace {

Solution solve_by_over_relaxation(const RadiositySystem& system, const SolverSettings& settings) {
  return relax(system, settings, settings.relaxation);
}

}  // namespace

SolverInfo over_relaxation_info() {
  return {"Gauss-Seidel with the relaxation factor. Factors slightly above 1 are fastest; 2 and more diverge",
          solve_by_over_relaxation};
}

}  // namespace etendue::radiosity
