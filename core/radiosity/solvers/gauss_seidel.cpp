// Gauss-Seidel iteration                                        [Lang, sec. 10.1.5, eq. 10.120-10.123, corrected]
//
//    B_i  <-  S_i + rho_i (sum over j < i of F_ij B_j(new)  +  sum over j > i of F_ij B_j(old))
//
// A sweep gathers light at every element and uses values of the same sweep. It converges about twice as fast as Jacobi's
// iteration.
#include "radiosity/solvers/relaxation.h"

namespace etendue::radiosity {
namespace {

std::unique_ptr<SolverIteration> begin_gauss_seidel(const RadiositySystem& system, const SolverSettings&) {
  return std::make_unique<Relaxation>(system, 1);
}

}  // namespace

SolverInfo gauss_seidel_info() {
  return {"Gathers light at every element in turn, with the newest values. About twice as fast as Jacobi's iteration",
          begin_gauss_seidel, sizeof(double)};
}

}  // namespace etendue::radiosity
