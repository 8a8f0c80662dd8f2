// A light that approaches the plane of the floor, and one that lies in it.   [Kajiya 1986]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void grazing_light(TestContext& test) {
  constexpr float kDistance = 10, kAlbedo = 0.5f;
  const Camera camera = narrow_camera({0, 3, 1}, {0, 0, 0});
  for (const float height : {1e-1f, 1e-2f, 1e-3f, 0.0f}) {
    scene::Scene scene;
    scene::add(scene, scene::quad(1), scene::diffuse(Rgb(kAlbedo)));
    // Above the horizon the light is a vertical disk that yields an irradiance of pi / (1 + height^2)^2. In the plane
    // it faces up as the floor does.
    const float radius = height > 0 ? 0.1f * kDistance * height : 0.1f;
    Material emitter = scene::diffuse(Rgb(0), Rgb(height > 0 ? sqr(kDistance / radius) / height : 1e6f));
    emitter.double_sided = false;
    Mat4 transform(1);  // faces -x
    if (height > 0) {
      transform[0] = Vec4(0, 1, 0, 0);
      transform[1] = Vec4(-1, 0, 0, 0);
    }
    transform[3] = Vec4(kDistance, height * kDistance, 0, 1);
    scene::add(scene, scene::disk(radius, 48), emitter, transform);
    const auto d = test.document(std::move(scene), camera);
    const std::string point = "height over distance " + number(height);
    const double measured = test.mean(TestContext::with_method(d, "path"), 64).value;
    if (height > 0)
      test.expect_near("path", point, measured, kAlbedo / sqr(1 + sqr(height)), 1e-3);
    else
      test.expect_zero("path", point, measured);
  }
}

inline constexpr Case kGrazingLight{
    .name = "grazing-light",
    .kind = Kind::geometry,
    .theory =
        "Irradiance at a grazing angle is proportional to the sine of the elevation down to the "
        "horizon, and zero in the plane itself",
    .run = grazing_light};

}  // namespace etendue::stress
