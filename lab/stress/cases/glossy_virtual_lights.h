// A metal wall that throws light back where it came from, and a floor beside.                          digest 8-10: F32
#pragma once
#include "stress/case.h"
#include "stress/lit_wall.h"

namespace etendue::stress {

inline void glossy_virtual_lights(Lab& lab) {
  constexpr float kDistance = 0.5f;
  Material metal;
  metal.base_color = Rgb(0.8f), metal.metallic = 1, metal.roughness = 0.25f;
  auto d = lab.document(lit_wall(metal, kDistance), camera_of_lit_wall(kDistance));
  d.width = d.height = 8;
  const double truth = lab.mean(Lab::with_method(d, "path"), 1024).value;
  lab.expect_near("igi:full-bsdf=true", "of the light",
                  lab.mean(Lab::with_method(d, "igi:light-paths=512:full-bsdf=true"), 32).value / truth, 1, 0.06);
  lab.expect_between("igi", "of the light", lab.mean(Lab::with_method(d, "igi:light-paths=512"), 32).value / truth, 1.5,
                     100);
}

inline constexpr Case kGlossyVirtualLights{"glossy-virtual-lights", Kind::bias,
                                           "Virtual lights that shine evenly show light where a glossy surface sends "
                                           "next to none; with its own BSDF they do not",
                                           glossy_virtual_lights};

}  // namespace etendue::stress
