// Gauss-Seidel iteration                                        [Lang, sec. 10.1.5, eq. 10.120-10.123, corrected]
//
//    B_i  <-  S_i + rho_i (sum over j < i of F_ij B_j(new)  +  sum over j > i of F_ij B_j(old))
//
// A sweep gathers light at every element and uses values of the same sweep. It converges about twice as fast as Jacobi's
// iteration.
#include "radiosity/solvers/relaxation.h"

namespace etendue::radiosity {
namespace {

Solution solve_by_gauss_seidel(const RadiositySystem& system, const SolverSettings& settings) {
  return relax(system, settings, 1);
}

}  // namespace

SolverInfo gauss_seidel_info() {
  return {"Gathers light at every element in turn, with the newest values. About twice as fast as Jacobi's iteration",
          solve_by_gauss_seidel};
}

}  // namespace etendue::radiosity
