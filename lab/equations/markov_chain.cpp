#include "equations/markov_chain.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>

#include "base/number_text.h"

namespace etendue::equations {
namespace {

constexpr double kRowTolerance = 1e-12;    // of the sum of a row
constexpr double kKernelTolerance = 1e-9;  // of zero pivots

Eigen::Index index(size_t i) { return static_cast<Eigen::Index>(i); }

Eigen::MatrixXd transition_matrix(const MarkovChain& chain) {
  Eigen::MatrixXd p(index(chain.size()), index(chain.size()));
  for (size_t i = 0; i < chain.size(); ++i)
    for (size_t j = 0; j < chain.size(); ++j) p(index(i), index(j)) = chain.transitions[i][j];
  return p;
}

}  // namespace

Result<void> check(const MarkovChain& chain) {
  for (size_t i = 0; i < chain.size(); ++i) {
    const auto& row = chain.transitions[i];
    const std::string where = "row " + std::to_string(i + 1) + " of the transition matrix";
    if (row.size() != chain.size())
      return input_error(where + " has " + std::to_string(row.size()) + " entries; give " +
                         std::to_string(chain.size()));
    double sum = 0;
    for (const double p : row) {
      if (!(p >= 0)) return input_error(where + " has the entry " + format_number(p) + "; give probabilities");
      sum += p;
    }
    if (std::abs(sum - 1) > kRowTolerance)
      return input_error(where + " has the sum " + format_number(sum, 6) + "; the sum of a row must be 1");
  }
  if (chain.size() == 0) return input_error("the chain has no states");
  return {};
}

Distribution next_distribution(const MarkovChain& chain, const Distribution& p) {
  Distribution next(chain.size(), 0.0);
  for (size_t i = 0; i < chain.size(); ++i)
    for (size_t j = 0; j < chain.size(); ++j) next[j] += p[i] * chain.transitions[i][j];
  return next;
}

size_t next_state(const MarkovChain& chain, size_t state, double u) {
  const auto& row = chain.transitions[state];
  size_t last = state;
  for (size_t j = 0; j < row.size(); ++j) {
    if (row[j] <= 0) continue;
    last = j;
    if (u < row[j]) return j;
    u -= row[j];
  }
  return last;  // the rounding error of the sum of the row
}

Result<Distribution> stationary_distribution(const MarkovChain& chain) {
  if (const auto valid = check(chain); !valid) return valid.error();
  const Eigen::MatrixXd p = transition_matrix(chain);
  Eigen::FullPivLU<Eigen::MatrixXd> lu(p.transpose() - Eigen::MatrixXd::Identity(p.rows(), p.cols()));
  lu.setThreshold(kKernelTolerance);
  if (lu.dimensionOfKernel() != 1)
    return input_error("the chain has " + std::to_string(lu.dimensionOfKernel()) +
                       " independent stationary distributions; which one it approaches depends on its start");
  const Eigen::VectorXd kernel = lu.kernel().col(0);
  const double sum = kernel.sum();
  Distribution stationary;
  for (Eigen::Index i = 0; i < kernel.size(); ++i) stationary.push_back(kernel[i] / sum);
  return stationary;
}

std::vector<double> eigenvalue_moduli(const MarkovChain& chain) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(transition_matrix(chain), false);
  std::vector<double> moduli;
  for (Eigen::Index i = 0; i < solver.eigenvalues().size(); ++i) moduli.push_back(std::abs(solver.eigenvalues()[i]));
  std::ranges::sort(moduli, std::greater<>());
  return moduli;
}

double total_variation(const Distribution& p, const Distribution& q) {
  double sum = 0;
  for (size_t i = 0; i < p.size(); ++i) sum += std::abs(p[i] - q[i]);
  return sum / 2;
}

}  // namespace etendue::equations
