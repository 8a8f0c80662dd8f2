// A luminous floor that touches a wall. A point that is sampled by area is worth h d / r^4, for a point of the wall at
// height h and one of the light at distance d from it. Both near the edge, it is above t with a probability of about
// t^(-3/2) where the light is even: no variance, k = 2/3. Directions to a lamp that looks large are worth no more than
// its radiance, and are what is sampled there. Where the light's density grows as 1/d its strips never look large near
// the edge: the probability is 1/t, k = 1.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

// Strips of equal power, each half as wide as the one before it; with one strip the light is even.
inline scene::Scene wall_on_a_light(int strips) {
  scene::Scene scene;
  Mat4 upright(1);  // facing +x
  upright[0] = Vec4(0, 1, 0, 0), upright[1] = Vec4(1, 0, 0, 0), upright[3] = Vec4(0, 1, 0, 1);
  scene::add(scene, scene::quad(1), scene::diffuse(Rgb(0.5f)), upright);
  for (int i = 0; i < strips; ++i) {
    const float far = std::exp2(static_cast<float>(-i)), near = i + 1 < strips ? 0.5f * far : 0;
    Mat4 place(1);
    place[0][0] = 0.5f * (far - near), place[3] = Vec4(0.5f * (far + near), 0, 0, 1);
    Material light = scene::diffuse(Rgb(0), Rgb(1 / (far - near)));
    light.double_sided = false;
    scene::add(scene, scene::quad(1), light, place);
  }
  return scene;
}

inline render::Document wall_on_a_light(const Lab& lab, int strips) {
  // The wall from the floor up, and nothing of the light.
  auto d =
      lab.document(wall_on_a_light(strips), look_at({3, 0.5f, 0}, {0, 0.5f, 0}, {0, 1, 0}, 2 * std::atan(0.5f / 3)));
  d.filter = film::FilterKind::box;
  return d;
}

// The mean over seeds: one khat is known to about 0.1.
inline double khat_of(Lab& lab, render::Document d) {
  constexpr int kSeeds = 12;
  double sum = 0;
  for (int i = 0; i < kSeeds; ++i) {
    ++d.seed;
    sum += lab.tail(d, 64).khat.value_or(0);
  }
  return sum / kSeeds;
}

inline void light_that_touches_a_wall(Lab& lab) {
  const auto even = wall_on_a_light(lab, 1), growing = wall_on_a_light(lab, 12);
  const std::string of_lamps = "raycast:lights=one";
  lab.expect_between(of_lamps, "khat under an even light", khat_of(lab, Lab::with_method(even, of_lamps)), -1, 0.3);
  lab.expect_near(of_lamps, "khat under one that grows to the edge", khat_of(lab, Lab::with_method(growing, of_lamps)),
                  1, 0.15);
  lab.expect_between("path", "khat under an even light", khat_of(lab, Lab::with_method(even, "path")), -1, 0.3);
}

inline constexpr Case kLightThatTouchesAWall{
    "light-that-touches-a-wall", Kind::heavy_tails,
    "A lamp sampled by area is worth 1/r^2, without variance near the edge where both touch; by direction, as it is "
    "where "
    "it looks large, it is bounded. Strips that get brighter and thinner towards the edge never look large: their tail "
    "index is 1. Shared with the directions of the BSDF all is bounded",
    light_that_touches_a_wall};

}  // namespace etendue::stress
