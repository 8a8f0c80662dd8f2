// A closed room whose walls reflect more than they receive.   [Lang, sec. 2.3, 6.7.2]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void room_that_makes_light(TestContext& test) {
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
    return test.document(std::move(scene), look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1));
  };
  const auto growth = [&](const render::Document& d) {
    const double before = test.mean(TestContext::with_method(d, "path:max-depth=6"), 64).value;
    return test.mean(TestContext::with_method(d, "path:max-depth=9"), 64).value / before;
  };
  // Walls of albedo 1/2: the ratio of nine terms of the series to six.
  test.expect_near("path", "Lambert, growth from 6 to 9 segments", growth(room("lambert", 0)),
                   (2 - std::pow(0.5, 8)) / (2 - std::pow(0.5, 5)), 0.01);
  // The albedo is 2.09 at normal and 0.7 at grazing incidence. On average it is above one, so the series diverges.
  test.expect_between("path", "reciprocal Phong, growth from 6 to 9 segments", growth(room("reciprocal-phong", 1)), 2,
                      10);
}

inline constexpr Case kRoomThatMakesLight{
    .name = "room-that-makes-light",
    .kind = Kind::broken_physics,
    .theory =
        "In a closed room of albedo 1/2 the Neumann series converges; with an albedo above one each "
        "bounce adds more than the one before, and no depth suffices",
    .run = room_that_makes_light};

}  // namespace etendue::stress
