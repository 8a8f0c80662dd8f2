// Surfaces in the plane of an area light, and a point light in the floor.   [Kajiya 1986]
#pragma once
#include "integrator/integrator.h"
#include "stress/case.h"

namespace etendue::stress {

inline void point_on_the_light(TestContext& test) {
  // A reflecting emitter beside another one in the same plane.
  scene::Scene emitters;
  for (const float x : {-1.0f, 1.0f}) {
    Mat4 transform(1);
    transform[3].x = x;
    scene::add(emitters, scene::quad(1), scene::diffuse(Rgb(0.5f), Rgb(1)), transform);
  }
  const auto flat = test.document(std::move(emitters), look_at({0, 1, 0}, {0, 0, 0}, {0, 0, 1}, 0.5f));
  // A point light at the point of the floor that the camera sees.
  scene::Scene floor;
  scene::add(floor, scene::quad(1), scene::diffuse(Rgb(0.5f)));
  add_point_light(floor, {0, 0, 0}, 1);
  const auto sunk = test.document(std::move(floor), narrow_camera({0, 1, 0.2f}, {0, 0, 0}));
  for (const auto& info : integrator::integrator_infos()) {
    const auto rendered_by = [&](const render::Document& d) { return TestContext::with_method(d, info.name); };
    test.expect_zero(info.name, "a point light in the floor", test.mean(rendered_by(sunk), 4).value);
    if (info.name == "light-pure") continue;  // incompatible with a pinhole
    const film::Mean mean = test.mean(rendered_by(flat), 16);
    if (info.group == integrator::Group::markov_chain)
      test.expect_near(info.name, "radiance of the emitter", mean.value, 1, 0.05);
    else
      test.expect_mean(info.name, "radiance of the emitter", mean, 1);
  }
}

inline constexpr Case kPointOnTheLight{
    .name = "point-on-the-light",
    .kind = Kind::geometry,
    .theory =
        "Coplanar points exchange no light, so an emitter shows its own radiance however close the "
        "connected points are, and nothing is divided by a distance of zero",
    .run = point_on_the_light};

}  // namespace etendue::stress
