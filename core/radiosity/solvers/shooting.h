// Shooting: the element with the largest unshot power sends it to all others.
//                                                            [Southwell 1940; Cohen et al. 1988; Lang, fig. 10.12, corrected]
#pragma once
#include <algorithm>
#include <cmath>
#include <numeric>

#include "radiosity/solver.h"

namespace etendue::radiosity {

// The state of Southwell's relaxation: B and the residual r, which is the radiosity that has not been shot.
class Shooting {
 public:
  explicit Shooting(const RadiositySystem& system)
      : system_(system), radiosity_(system.size()), unshot_(system.source), power_(system.size()) {
    for (size_t i = 0; i < power_.size(); ++i) power_[i] = system.factors->areas()[i] * std::abs(unshot_[i]);
  }

  // As many shots as there are elements, or until nothing is left. False if it was stopped; the next call continues.
  bool sweep(const KeepGoing* keep_going) {
    // The search for the strongest element takes as many operations as there are elements.
    const auto cost = [&](size_t) { return system_.size(); };
    if (!continue_loop(next_, system_.size(), keep_going, cost, [&](size_t) { shoot(); })) return false;
    next_ = 0;
    return true;
  }
  // One shot: [Lang, fig. 10.12] with the diagonal element of the row that is relaxed.
  void shoot() {
    const FormFactors& factors = *system_.factors;
    const size_t i = is_done_ ? 0 : strongest();
    if (is_done_ || unshot_[i] == 0) return void(is_done_ = true);
    const double shot = unshot_[i] / system_.diagonal(i);
    unshot_[i] = power_[i] = 0;
    radiosity_[i] += shot;
    ++shots_;
    // Reciprocity: the column of the matrix is a row of the symmetric exchanges.
    for (const FormFactor& f : factors.exchanges(i)) {
      const size_t j = f.element;
      if (j == i) continue;
      unshot_[j] += system_.reflectance[j] * static_cast<double>(f.value) / factors.areas()[j] * shot;
      power_[j] = factors.areas()[j] * std::abs(unshot_[j]);
    }
  }

  const std::vector<double>& radiosity() const { return radiosity_; }
  const std::vector<double>& unshot() const { return unshot_; }
  size_t shots() const { return shots_; }
  bool is_done() const { return is_done_; }  // nothing is left to shoot
  // The power A |r| that has not been shot, W. It never grows if no element reflects more than it receives.
  double unshot_power() const { return std::accumulate(power_.begin(), power_.end(), 0.0); }

 private:
  // A search over all elements is faster than a queue, because a shot changes the power of most of them.
  size_t strongest() const {
    return static_cast<size_t>(std::max_element(power_.begin(), power_.end()) - power_.begin());
  }

  const RadiositySystem& system_;
  std::vector<double> radiosity_, unshot_;
  std::vector<double> power_;  // A |r|
  size_t next_ = 0, shots_ = 0;
  bool is_done_ = false;
};

}  // namespace etendue::radiosity
