// Southwell relaxation                                  [Southwell 1940; Lang, sec. 10.1.5, fig. 10.12, corrected]
//
// The element with the largest unshot power A_i |r_i| shoots its residual r_i to all others. The unshot power never grows
// [Gortler et al. 1994]; the sum of |r_i| can grow if areas differ.
#include "radiosity/solvers/shooting.h"

namespace etendue::radiosity {
namespace {

class Southwell final : public SolverIteration {
 public:
  explicit Southwell(const RadiositySystem& system) : shooting_(system) {}

  bool sweep(const KeepGoing* keep_going) override { return shooting_.sweep(keep_going); }
  std::vector<double> radiosity() const override { return shooting_.radiosity(); }
  bool can_improve() const override { return !shooting_.is_done(); }

 private:
  Shooting shooting_;
};

std::unique_ptr<SolverIteration> begin_southwell(const RadiositySystem& system, const SolverSettings&) {
  return std::make_unique<Southwell>(system);
}

}  // namespace

SolverInfo southwell_info() {
  return {
      "The element with the largest unshot power shoots it to all others. Bright light first; a sweep is as many "
      "shots as there are elements",
      begin_southwell, 3 * sizeof(double)};
}

}  // namespace etendue::radiosity
