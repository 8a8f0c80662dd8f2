// Neumann series                                                        [Lang, sec. 10.1.5, eq. 10.100-10.106]
//
//    B  =  sum over n of (rho F)^n S
//
// Term n is the light that was reflected n times after the source. The partial sums are the iterates of Jacobi's method.
#include "radiosity/solver.h"

namespace etendue::radiosity {
namespace {

class Neumann final : public SolverIteration {
 public:
  explicit Neumann(const RadiositySystem& system)
      : system_(system), sum_(system.source), term_(system.source), next_term_(system.size()) {}

  bool sweep(const KeepGoing* keep_going) override {
    const auto cost = [&](size_t i) { return 1 + system_.factors->exchanges(i).size(); };
    const auto reflect = [&](size_t i) { next_term_[i] = system_.reflected_at(i, term_); };
    if (!continue_loop(next_, system_.size(), keep_going, cost, reflect)) return false;
    next_ = 0;
    term_.swap(next_term_);
    for (size_t i = 0; i < term_.size(); ++i) sum_[i] += term_[i];
    return true;
  }
  std::vector<double> radiosity() const override { return sum_; }

 private:
  const RadiositySystem& system_;
  std::vector<double> sum_, term_, next_term_;
  size_t next_ = 0;
};

std::unique_ptr<SolverIteration> begin_neumann(const RadiositySystem& system, const SolverSettings&) {
  return std::make_unique<Neumann>(system);
}

}  // namespace

SolverInfo neumann_info() {
  return {"Adds the light of one reflection after the other. The same iterates as Jacobi's method", begin_neumann,
          3 * sizeof(double)};
}

}  // namespace etendue::radiosity
