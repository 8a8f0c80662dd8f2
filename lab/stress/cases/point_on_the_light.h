// What lies in a lamp, and in the plane of one.                                                        digest 8-10: F26
#pragma once
#include "integrator/integrator.h"
#include "stress/case.h"

namespace etendue::stress {

inline void point_on_the_light(Lab& lab) {
  // The lamp itself, which reflects, and that another lamp of the same plane touches.
  scene::Scene lamps;
  for (const float x : {-1.0f, 1.0f}) {
    Mat4 place(1);
    place[3].x = x;
    scene::add(lamps, scene::quad(1), scene::diffuse(Rgb(0.5f), Rgb(1)), place);
  }
  const auto flat = lab.document(std::move(lamps), look_at({0, 1, 0}, {0, 0, 0}, {0, 0, 1}, 0.5f));
  // A point light in the floor, where the camera looks.
  scene::Scene floor;
  scene::add(floor, scene::quad(1), scene::diffuse(Rgb(0.5f)));
  add_point_light(floor, {0, 0, 0}, 1);
  const auto sunk = lab.document(std::move(floor), telescope({0, 1, 0.2f}, {0, 0, 0}));
  for (const auto& info : integrator::integrator_infos()) {
    const auto by = [&](const render::Document& d) { return Lab::with_method(d, info.name); };
    lab.expect_zero(info.name, "a point light in the floor", lab.mean(by(sunk), 4).value);
    if (info.name == "light-pure") continue;  // through a pinhole
    const film::Mean shown = lab.mean(by(flat), 16);
    if (info.group == integrator::Group::markov_chain)
      lab.expect_near(info.name, "the lamp's own radiance", shown.value, 1, 0.05);
    else
      lab.expect_mean(info.name, "the lamp's own radiance", shown, 1);
  }
}

inline constexpr Case kPointOnTheLight{
    "point-on-the-light", Kind::geometry,
    "A plane sends itself nothing: a lamp shows its own radiance, however near to each other the points of it are that "
    "a method connects, and nothing is divided by a distance of zero",
    point_on_the_light};

}  // namespace etendue::stress
