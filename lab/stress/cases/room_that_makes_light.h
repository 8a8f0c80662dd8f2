// A closed room whose walls send back more than they get.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void room_that_makes_light(Lab& lab) {
  const auto room = [&](const char* model, double specular) {
    scene::Scene scene;
    Material wall = scene::diffuse(Rgb(0), Rgb(1));
    wall.model.model = make_bsdf_model(model);
    if (specular > 0) {
      auto& m = wall.model.model;
      for (const char* band : {"specular.r", "specular.g", "specular.b"}) m = m->with(band, specular);
      m = m->with("exponent", 1.0);
    } else {
      wall.model.model = wall.model.model->with("diffuse", 0.5);
      wall.base_color = Rgb(1);
    }
    scene::add(scene, scene::cube(1, true), wall);
    return lab.document(std::move(scene), look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1));
  };
  const auto growth = [&](const render::Document& d) {
    const double before = lab.mean(Lab::with_method(d, "path:max-depth=6"), 64).value;
    return lab.mean(Lab::with_method(d, "path:max-depth=9"), 64).value / before;
  };
  // Walls of albedo 1/2: from six terms of the series to nine.
  lab.expect_near("path", "Lambert, growth from 6 to 9 edges", growth(room("lambert", 0)),
                  (2 - std::pow(0.5, 8)) / (2 - std::pow(0.5, 5)), 0.01);
  // Its albedo is 2.09 from the front and 0.7 along the surface: above one on the whole, and powers of it win.
  lab.expect_between("path", "reciprocal Phong, growth from 6 to 9 edges", growth(room("reciprocal-phong", 1)), 2, 10);
}

inline constexpr Case kRoomThatMakesLight{"room-that-makes-light", Kind::broken_physics,
                                          "In a closed room of albedo 1/2 the series of bounces is finite; with walls "
                                          "that make light no depth is enough, and "
                                          "each bounce brings more than the one before",
                                          room_that_makes_light};

}  // namespace etendue::stress
