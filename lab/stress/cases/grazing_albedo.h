// A white dielectric floor under a uniform sky, from above and at a grazing angle.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void grazing_albedo(Lab& lab) {
  for (const float degrees : {0.0f, 60.0f, 88.0f}) {
    scene::Scene scene = sky();
    Material white;
    white.metallic = 0, white.roughness = 0.3f;
    scene::add(scene, scene::quad(100), white);
    const float angle = degrees * kPi / 180;
    const Vec3 eye = 10.0f * Vec3(std::sin(angle), std::cos(angle), 0);
    auto d = lab.document(std::move(scene), look_at(eye, {0, 0, 0}, {0, 0, 1}, 1e-4f));
    const double albedo = lab.mean(Lab::with_method(d, "path"), 256).value;
    if (degrees < 80)
      lab.expect_between("path", "albedo at " + number(degrees) + " degrees", albedo, 0.9, 1.03);
    else
      lab.expect_between("path", "albedo at " + number(degrees) + " degrees", albedo, 1.05, 1.6);
  }
}

inline constexpr Case kGrazingAlbedo{
    "grazing-albedo", Kind::broken_physics,
    "glTF's layered surface weakens its base by 1 - F(wo.h), which is more than the layer leaves at grazing angles: a "
    "white one gains energy there, and it must be seen, not hidden",
    grazing_albedo};

}  // namespace etendue::stress
