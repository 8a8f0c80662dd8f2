// Southwell relaxation                                  [Southwell 1940; Lang, sec. 10.1.5, fig. 10.12, corrected]
//
// The element with the largest unshot power A_i |r_i| shoots its residual r_i to all others. The unshot power never grows
// [Gortler et al. 1994]; the sum of |r_i| can grow if areas differ.
#include "radiosity/solvers/shooting.h"

namespace etendue::radiosity {
namespace {

Solution solve_by_southwell(const RadiositySystem& system, const SolverSettings& settings) {
  SolverProgress progress(system, settings);
  Shooting shooting(system);
  while (progress.should_continue(shooting.radiosity())) shooting.sweep();
  return progress.finish(shooting.radiosity());
}

}  // namespace

SolverInfo southwell_info() {
  return {
      "The element with the largest unshot power shoots it to all others. Bright light first; a sweep is as many "
      "shots as there are elements",
      solve_by_southwell};
}

}  // namespace etendue::radiosity
