// The edge of a sharp shadow, and photon lookups that reach across it.   [Jensen 2001; Lang, sec. 9.5.3]
#pragma once
#include "stress/case.h"
#include "stress/lit_plate.h"

namespace etendue::stress {

inline void photons_at_a_shadow(TestContext& test) {
  constexpr double kRadius = 0.2;
  scene::Scene scene = lit_plate();
  Mat4 roof(1);
  roof[3] = Vec4(-2, 0.5f, 0, 1);
  scene::add(scene, scene::quad(2), scene::diffuse(Rgb(0)), roof);
  const double diagonal = std::sqrt(sqr(5.0) + sqr(4.0) + sqr(0.5));
  // In radii: far inside the lit region, at the edge, half a radius and two radii into the shadow.
  for (const double behind : {-2.0, 0.0, 0.5, 2.0}) {
    const auto x = static_cast<float>(-behind * kRadius);
    auto d = test.document(scene, narrow_camera({x + 0.2f, 0.2f, 0}, {x, 0, 0}));
    d.width = d.height = 4;
    const double c = std::clamp(behind, -1.0, 1.0);
    const double lit = (std::acos(c) - c * std::sqrt(1 - c * c)) / double{kPi};
    const std::string map = "photonmap:photons=400000:nearest=100000:renew=true:radius=" + number(kRadius / diagonal);
    const std::string point = number(behind) + " radii into the shadow";
    const double direct = test.mean(TestContext::with_method(d, map + ":mode=direct"), 2).value / kRadianceOfLitPlate;
    if (lit > 0)
      test.expect_near("photonmap:mode=direct", point, direct, lit, 0.1);
    else
      test.expect_zero("photonmap:mode=direct", point, direct);
    if (behind != 0)
      test.expect_near("photonmap", point, test.mean(TestContext::with_method(d, map), 1).value / kRadianceOfLitPlate,
                       behind < 0 ? 1 : 0, 1e-3);
  }
}

inline constexpr Case kPhotonsAtAShadow{
    .name = "photons-at-a-shadow",
    .kind = Kind::bias,
    .theory =
        "Photon lookups blur the edge of a shadow over their radius and leak light behind it, in "
        "proportion to the part of the lookup disc that is lit",
    .run = photons_at_a_shadow};

}  // namespace etendue::stress
