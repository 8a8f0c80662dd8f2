// The edge of a sharp shadow, and discs of photons that reach across.                                  digest 8-10: F10
#pragma once
#include "stress/case.h"
#include "stress/lit_plate.h"

namespace etendue::stress {

inline void photons_at_a_shadow(Lab& lab) {
  constexpr double kRadius = 0.2;
  scene::Scene scene = lit_plate();
  Mat4 roof(1);
  roof[3] = Vec4(-2, 0.5f, 0, 1);
  scene::add(scene, scene::quad(2), scene::diffuse(Rgb(0)), roof);
  const double diagonal = std::sqrt(sqr(5.0) + sqr(4.0) + sqr(0.5));
  // Far into the light, at the edge, half a radius behind it, two radii behind it.
  for (const double behind : {-2.0, 0.0, 0.5, 2.0}) {
    const auto x = static_cast<float>(-behind * kRadius);
    auto d = lab.document(scene, telescope({x + 0.2f, 0.2f, 0}, {x, 0, 0}));
    d.width = d.height = 4;
    const double c = std::clamp(behind, -1.0, 1.0);
    const double lit = (std::acos(c) - c * std::sqrt(1 - c * c)) / double{kPi};
    const std::string map = "photonmap:photons=400000:nearest=100000:renew=true:radius=" + number(kRadius / diagonal);
    const std::string point = number(behind) + " radii into the shadow";
    const double direct = lab.mean(Lab::with_method(d, map + ":mode=direct"), 2).value / kRadianceOfLitPlate;
    if (lit > 0)
      lab.expect_near("photonmap:mode=direct", point, direct, lit, 0.1);
    else
      lab.expect_zero("photonmap:mode=direct", point, direct);
    if (behind != 0)
      lab.expect_near("photonmap", point, lab.mean(Lab::with_method(d, map), 1).value / kRadianceOfLitPlate,
                      behind < 0 ? 1 : 0, 1e-3);
  }
}

inline constexpr Case kPhotonsAtAShadow{
    "photons-at-a-shadow", Kind::bias,
    "Lookups smooth the edge of a shadow over their radius, and bring light to where there is none, as they do behind "
    "thin walls: as much as the part of their disc that lies in the light",
    photons_at_a_shadow};

}  // namespace etendue::stress
