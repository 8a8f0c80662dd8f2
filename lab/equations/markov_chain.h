// Markov chains with finitely many states: distribution after n steps, stationary distribution, simulation
// [Lang, eq. 2.881-2.903, 6.344-6.348].
#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "equations/random_numbers.h"

namespace etendue::equations {

using Distribution = std::vector<double>;  // probabilities of the states

struct MarkovChain {
  std::vector<std::string> states;               // names
  std::vector<std::vector<double>> transitions;  // row i: probabilities of the states that follow state i
  size_t size() const { return transitions.size(); }
};

// An input error if a row has another length, a negative entry, or a sum that differs from 1 [Lang, eq. 2.897].
Result<void> check(const MarkovChain& chain);

// The distribution after one more step: p P.
Distribution next_distribution(const MarkovChain& chain, const Distribution& p);

// The state that follows `state`, for a uniform number.
size_t next_state(const MarkovChain& chain, size_t state, double u);

// The solution of p P = p with sum 1. An input error if there is more than one.
Result<Distribution> stationary_distribution(const MarkovChain& chain);

// The moduli of the eigenvalues of P, the largest first. The second one is the factor by which the distance to the
// stationary distribution falls in each step; at 1 the chain is periodic or has several stationary distributions.
std::vector<double> eigenvalue_moduli(const MarkovChain& chain);

// Half of the sum of |p_i - q_i|.
double total_variation(const Distribution& p, const Distribution& q);

}  // namespace etendue::equations
