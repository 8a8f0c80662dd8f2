// Elements that see themselves: two concentric spheres as one element each.   [Lang, fig. 10.12, corrected]
#pragma once
#include "radiosity/solver.h"
#include "stress/case.h"

namespace etendue::stress {

inline void concave_patches(TestContext& test) {
  using namespace radiosity;
  // Areas 1 and 4; three quarters of the light of the outer sphere return to it.
  std::vector<FormFactorRow> rows{{{1, 1.0f}}, {{0, 0.25f}, {1, 0.75f}}};
  const FormFactors factors(std::move(rows), {1, 4});
  for (size_t k = 0; k < Options<SolverKind>::kOptions.size(); ++k) {
    const RadiositySystem system{&factors, {0.5, 0.8}, {1, 0}};
    const Solution s = solve(static_cast<SolverKind>(k), system, {.tolerance = 1e-9});
    const char* name = Options<SolverKind>::kOptions[k].name;
    test.expect_near(name, "inner sphere", s.radiosity[0], 4.0 / 3, 1e-6);
    test.expect_near(name, "outer sphere", s.radiosity[1], 2.0 / 3, 1e-6);
  }
}

inline constexpr Case kConcavePatches{
    .name = "concave-patches",
    .kind = Kind::geometry,
    .theory =
        "An element that sees itself has a diagonal element 1 - reflectance F_ii of its own. Relaxation divides by the "
        "one "
        "of the relaxed row; by that of another row, the outer sphere gets the wrong radiosity",
    .run = concave_patches};

}  // namespace etendue::stress
