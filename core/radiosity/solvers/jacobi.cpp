// Jacobi iteration                                              [Lang, sec. 10.1.5, eq. 10.115-10.119, corrected]
//
//    B_i  <-  S_i + rho_i  sum over j of F_ij B_j(old)
//
// A sweep gathers light at every element from the values of the sweep before. Starting with the source, n sweeps give the
// light of at most n reflections more.
#include "radiosity/solver.h"

namespace etendue::radiosity {
namespace {

Solution solve_by_jacobi(const RadiositySystem& system, const SolverSettings& settings) {
  SolverProgress progress(system, settings);
  std::vector<double> b = system.source, next(b.size());
  while (progress.should_continue(b)) {
    for (size_t i = 0; i < b.size(); ++i) next[i] = b[i] + system.residual_at(i, b);
    b.swap(next);
  }
  return progress.finish(std::move(b));
}

}  // namespace

SolverInfo jacobi_info() {
  return {"Gathers light at every element from the values of the previous sweep: one more reflection per sweep",
          solve_by_jacobi};
}

}  // namespace etendue::radiosity
