// Virtual lights on a wall, seen from a floor at decreasing distance.   [Keller 1997; Kollig and Keller 2004]
#pragma once
#include "stress/case.h"
#include "stress/lit_wall.h"

namespace etendue::stress {

inline void virtual_lights_in_a_corner(TestContext& test) {
  struct Row {
    float distance;
    const char* bound;
    double share;  // of the light that remains with the bound, by quadrature
  };
  constexpr Row kRows[] = {{0.5f, "1", 0.972}, {0.1f, "1", 0.346}, {0.1f, "10", 0.828}, {0.01f, "10", 0.200}};
  for (const auto& [distance, bound, share] : kRows) {
    auto d = test.document(lit_wall(scene::diffuse(Rgb(0.8f)), distance), camera_of_lit_wall(distance));
    d.width = d.height = 4;
    const double exact = 0.5 / double{kPi} * 0.8 * form_factor_of_lit_wall(double{distance});
    const std::string method = std::string("igi:light-paths=512:bound=") + bound;
    const std::string point = "fraction of the light, " + number(double{distance}) + " m from the wall";
    test.expect_near(method + ":compensate=false", point,
                     test.mean(TestContext::with_method(d, method + ":compensate=false"), 64).value / exact, share,
                     0.05);
    test.expect_near(method, point, test.mean(TestContext::with_method(d, method), 64).value / exact, 1, 0.06);
  }
}

inline constexpr Case kVirtualLightsInACorner{
    .name = "virtual-lights-in-a-corner",
    .kind = Kind::bias,
    .theory =
        "The geometry term grows as 1 / distance^2: bounding it loses light in corners by an amount "
        "given by an integral, and bias compensation restores it",
    .run = virtual_lights_in_a_corner};

}  // namespace etendue::stress
