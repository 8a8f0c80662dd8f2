// Progressive refinement                                                                          [Cohen et al. 1988]
//
// Southwell relaxation whose intermediate results include the unshot light and an estimate of its reflections: an ambient
// radiosity as in a scene whose elements all see each other in proportion to their areas,
//
//    B_i  ~  B_i + r_i + rho_i ambient,     ambient = mean of r / (1 - mean of rho)
//
// with means over the area.
#include "radiosity/solvers/shooting.h"

namespace etendue::radiosity {
namespace {

// The radiosity with unshot and ambient light.
std::vector<double> with_ambient(const RadiositySystem& system, const Shooting& shooting) {
  double area = 0, unshot = 0, reflected = 0;
  for (size_t i = 0; i < system.size(); ++i) {
    const double a = system.factors->areas()[i] * (system.factors->exchanges(i).empty() ? 0 : 1);
    area += a;
    unshot += a * shooting.unshot()[i];
    reflected += a * system.reflectance[i];
  }
  const double absorbed = area - reflected;
  const double ambient = absorbed > 0 ? unshot / absorbed : 0;
  std::vector<double> b = shooting.radiosity();
  for (size_t i = 0; i < system.size(); ++i)
    b[i] += shooting.unshot()[i] + (system.factors->exchanges(i).empty() ? 0 : system.reflectance[i] * ambient);
  return b;
}

class Progressive final : public SolverIteration {
 public:
  explicit Progressive(const RadiositySystem& system) : system_(system), shooting_(system) {}

  bool sweep(const KeepGoing* keep_going) override { return shooting_.sweep(keep_going); }
  std::vector<double> radiosity() const override { return with_ambient(system_, shooting_); }
  bool can_improve() const override { return !shooting_.is_done(); }

 private:
  const RadiositySystem& system_;
  Shooting shooting_;
};

std::unique_ptr<SolverIteration> begin_progressive(const RadiositySystem& system, const SolverSettings&) {
  return std::make_unique<Progressive>(system);
}

}  // namespace

SolverInfo progressive_info() {
  return {"Shooting with an ambient term for the light that has not been shot: the best early results",
          begin_progressive, 3 * sizeof(double)};
}

}  // namespace etendue::radiosity
