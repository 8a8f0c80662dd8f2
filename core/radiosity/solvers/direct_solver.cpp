// LU decomposition of the dense matrix                                             [Lang, sec. 10.1.5, eq. 10.100]
//
// The reference for the iterative solvers. Time grows with n^3 and memory with n^2.
#include <Eigen/LU>
#include <limits>

#include "radiosity/solver.h"

namespace etendue::radiosity {
namespace {

constexpr size_t kMostElements = 8192;  // a matrix of 512 MiB

Solution solve_directly(const RadiositySystem& system, const SolverSettings& settings) {
  if (system.size() > kMostElements) {
    Solution refused;
    refused.radiosity = system.source;
    refused.status = SolverStatus::unfinished;
    refused.error_bound = std::numeric_limits<double>::infinity();
    refused.problem = "the dense matrix of " + std::to_string(system.size()) + " elements is too large: at most " +
                      std::to_string(kMostElements / 2) + " patches fit; use fewer patches or an iterative solver";
    return refused;
  }
  const auto n = static_cast<Eigen::Index>(system.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
  for (size_t i = 0; i < system.size(); ++i)
    for (const FormFactor& f : system.factors->exchanges(i))
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(f.element)) -=
          system.reflectance[i] * static_cast<double>(f.value) / system.factors->areas()[i];
  SolverProgress progress(system, settings);
  progress.should_continue(system.source);
  const Eigen::VectorXd source = Eigen::Map<const Eigen::VectorXd>(system.source.data(), n);
  const Eigen::VectorXd b = n > 0 ? Eigen::VectorXd(matrix.partialPivLu().solve(source)) : source;
  std::vector<double> radiosity(b.data(), b.data() + n);
  progress.should_continue(radiosity);
  return progress.finish(std::move(radiosity));
}

}  // namespace

SolverInfo direct_solver_info() {
  return {
      "LU decomposition: exact up to rounding. Time grows with the third power of the number of elements; at most "
      "4096 patches",
      solve_directly};
}

}  // namespace etendue::radiosity
