// Virtual lights all over a wall, seen from a floor that comes ever closer.                        digest 8-10: F9, O19
#pragma once
#include "stress/case.h"
#include "stress/lit_wall.h"

namespace etendue::stress {

inline void virtual_lights_in_a_corner(Lab& lab) {
  struct Kept {
    float distance;
    const char* bound;
    double share;
  };
  // Of the light that a bound keeps, by quadrature.
  constexpr Kept kKept[] = {{0.5f, "1", 0.972}, {0.1f, "1", 0.346}, {0.1f, "10", 0.828}, {0.01f, "10", 0.200}};
  for (const auto& [distance, bound, share] : kKept) {
    auto d = lab.document(lit_wall(scene::diffuse(Rgb(0.8f)), distance), camera_of_lit_wall(distance));
    d.width = d.height = 4;
    const double whole = 0.5 / double{kPi} * 0.8 * form_factor_of_lit_wall(double{distance});
    const std::string method = std::string("igi:light-paths=512:bound=") + bound;
    const std::string point = "of the light, " + number(double{distance}) + " m from the wall";
    lab.expect_near(method + ":compensate=false", point,
                    lab.mean(Lab::with_method(d, method + ":compensate=false"), 64).value / whole, share, 0.05);
    lab.expect_near(method, point, lab.mean(Lab::with_method(d, method), 64).value / whole, 1, 0.06);
  }
}

inline constexpr Case kVirtualLightsInACorner{
    "virtual-lights-in-a-corner", Kind::bias,
    "Connections grow as one over the squared distance: bounded they lose light in corners, as much as an integral "
    "says, and walks find it again",
    virtual_lights_in_a_corner};

}  // namespace etendue::stress
