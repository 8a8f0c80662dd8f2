// Jacobi iteration                                              [Lang, sec. 10.1.5, eq. 10.115-10.119, corrected]
//
//    B_i  <-  S_i + rho_i  sum over j of F_ij B_j(old)
//
// A sweep gathers light at every element from the values of the sweep before. Starting with the source, n sweeps give the
// light of at most n reflections more.
#include "radiosity/solver.h"

namespace etendue::radiosity {
namespace {

class Jacobi final : public SolverIteration {
 public:
  explicit Jacobi(const RadiositySystem& system)
      : system_(system), radiosity_(system.source), next_radiosity_(system.size()) {}

  bool sweep(const KeepGoing* keep_going) override {
    const auto cost = [&](size_t i) { return 1 + system_.factors->exchanges(i).size(); };
    const auto gather = [&](size_t i) { next_radiosity_[i] = radiosity_[i] + system_.residual_at(i, radiosity_); };
    if (!continue_loop(next_, system_.size(), keep_going, cost, gather)) return false;
    next_ = 0;
    radiosity_.swap(next_radiosity_);
    return true;
  }
  std::vector<double> radiosity() const override { return radiosity_; }

 private:
  const RadiositySystem& system_;
  std::vector<double> radiosity_, next_radiosity_;
  size_t next_ = 0;
};

std::unique_ptr<SolverIteration> begin_jacobi(const RadiositySystem& system, const SolverSettings&) {
  return std::make_unique<Jacobi>(system);
}

}  // namespace

SolverInfo jacobi_info() {
  return {"Gathers light at every element from the values of the previous sweep: one more reflection per sweep",
          begin_jacobi, 2 * sizeof(double)};
}

}  // namespace etendue::radiosity
