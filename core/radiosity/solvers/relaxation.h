// Sweeps over all elements in order, with a relaxation factor.                        [Lang, eq. 2.514-2.524, corrected]
#pragma once
#include "radiosity/solver.h"

namespace etendue::radiosity {

// B_i <- B_i + factor * r_i / m_ii with the newest values of all elements. The diagonal m_ii = 1 - rho_i F_ii of the
// matrix is 1 for patches, which do not see themselves.
class Relaxation final : public SolverIteration {
 public:
  Relaxation(const RadiositySystem& system, double factor)
      : system_(system), factor_(factor), radiosity_(system.source) {}

  bool sweep(const KeepGoing* keep_going) override {
    const auto cost = [&](size_t i) { return 1 + system_.factors->exchanges(i).size(); };
    const auto update = [&](size_t i) {
      radiosity_[i] += factor_ * system_.residual_at(i, radiosity_) / system_.diagonal(i);
    };
    if (!continue_loop(next_, system_.size(), keep_going, cost, update)) return false;
    next_ = 0;
    return true;
  }
  std::vector<double> radiosity() const override { return radiosity_; }

 private:
  const RadiositySystem& system_;
  double factor_;
  std::vector<double> radiosity_;
  size_t next_ = 0;
};

}  // namespace etendue::radiosity
