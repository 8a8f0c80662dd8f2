// Successive over-relaxation                                                            [Lang, eq. 2.523, 2.524]
//
//    B_i  <-  (1 - alpha) B_i  +  alpha (Gauss-Seidel update of B_i)
//
// It is Gauss-Seidel iteration for alpha = 1, and diverges for alpha >= 2.
#include "radiosity/solvers/relaxation.h"

namespace etendue::radiosity {
namespace {

std::unique_ptr<SolverIteration> begin_over_relaxation(const RadiositySystem& system, const SolverSettings& settings) {
  return std::make_unique<Relaxation>(system, settings.relaxation);
}

}  // namespace

SolverInfo over_relaxation_info() {
  return {"Gauss-Seidel with the relaxation factor. Factors slightly above 1 are fastest; 2 and more diverge",
          begin_over_relaxation, sizeof(double)};
}

}  // namespace etendue::radiosity
