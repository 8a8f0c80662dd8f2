// Neumann series                                                        [Lang, sec. 10.1.5, eq. 10.100-10.106]
//
//    B  =  sum over n of (rho F)^n S
//
// Term n is the light that was reflected n times after the source. The partial sums are the iterates of Jacobi's method.
#include "radiosity/solver.h"

namespace etendue::radiosity {
namespace {

Solution solve_by_neumann(const RadiositySystem& system, const SolverSettings& settings) {
  SolverProgress progress(system, settings);
  std::vector<double> sum = system.source, term = sum, next(sum.size());
  while (progress.should_continue(sum)) {
    for (size_t i = 0; i < term.size(); ++i)
      next[i] = system.reflectance[i] > 0 ? system.reflectance[i] * system.factors->row_times(i, term) : 0;
    term.swap(next);
    for (size_t i = 0; i < term.size(); ++i) sum[i] += term[i];
  }
  return progress.finish(std::move(sum));
}

}  // namespace

SolverInfo neumann_info() {
  return {"Adds the light of one reflection after the other. The same iterates as Jacobi's method", solve_by_neumann};
}

}  // namespace etendue::radiosity
