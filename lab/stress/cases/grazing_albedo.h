// A white dielectric floor under a uniform sky, from above and at a grazing angle.   [glTF 2.0, appendix B]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void grazing_albedo(TestContext& test) {
  for (const float degrees : {0.0f, 60.0f, 88.0f}) {
    scene::Scene scene = uniform_sky();
    Material white;
    white.metallic = 0;
    white.roughness = 0.3f;
    scene::add(scene, scene::quad(100), white);
    const float angle = degrees * kPi / 180;
    const Vec3 eye = 10.0f * Vec3(std::sin(angle), std::cos(angle), 0);
    auto d = test.document(std::move(scene), look_at(eye, {0, 0, 0}, {0, 0, 1}, 1e-4f));
    const double albedo = test.mean(TestContext::with_method(d, "path"), 256).value;
    if (degrees < 80)
      test.expect_between("path", "albedo at " + number(degrees) + " degrees", albedo, 0.9, 1.03);
    else
      test.expect_between("path", "albedo at " + number(degrees) + " degrees", albedo, 1.05, 1.6);
  }
}

inline constexpr Case kGrazingAlbedo{
    .name = "grazing-albedo",
    .kind = Kind::broken_physics,
    .theory =
        "The dielectric of glTF scales its base by 1 - F(wo.h). At grazing angles the specular layer "
        "transmits less than that, so a white surface has an albedo above one, which must be visible",
    .run = grazing_albedo};

}  // namespace etendue::stress
