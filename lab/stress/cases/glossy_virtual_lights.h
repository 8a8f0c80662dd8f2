// A rough metal wall that reflects light back to where it came from, and a floor beside it.   [Lang, sec. 9.6; Keller
// 1997]
#pragma once
#include "stress/case.h"
#include "stress/lit_wall.h"

namespace etendue::stress {

inline void glossy_virtual_lights(TestContext& test) {
  constexpr float kDistance = 0.5f;
  Material metal;
  metal.base_color = Rgb(0.8f);
  metal.metallic = 1;
  metal.roughness = 0.25f;
  auto d = test.document(lit_wall(metal, kDistance), camera_of_lit_wall(kDistance));
  d.width = d.height = 8;
  const double truth = test.mean(TestContext::with_method(d, "path"), 1024).value;
  test.expect_near("igi:full-bsdf=true", "fraction of the light",
                   test.mean(TestContext::with_method(d, "igi:light-paths=512:full-bsdf=true"), 32).value / truth, 1,
                   0.06);
  test.expect_between("igi", "fraction of the light",
                      test.mean(TestContext::with_method(d, "igi:light-paths=512"), 32).value / truth, 1.5, 100);
}

inline constexpr Case kGlossyVirtualLights{
    .name = "glossy-virtual-lights",
    .kind = Kind::bias,
    .theory =
        "Virtual lights with a diffuse emission show light where a glossy surface reflects almost "
        "none; with the complete BSDF they do not",
    .run = glossy_virtual_lights};

}  // namespace etendue::stress
