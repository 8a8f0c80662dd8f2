// A luminous floor that touches a wall. Sampled by area, a point of the wall at height h receives h d / r^4 from a
// point of the light at distance d. Near the edge this exceeds t with a probability of about t^(-3/2) for uniform
// emission: the variance is infinite and k = 2/3. Solid angle sampling, which is used where the light subtends a large
// solid angle, is bounded by the radiance. If the emitted power per area grows as 1/d, the strips near the edge are too
// narrow for solid angle sampling; the probability is 1/t and k = 1.   [Kollig and Keller 2004; Arvo 1995]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

// A wall and a floor of emitting strips of equal power, each half as wide as the previous one. A single strip emits
// uniformly.
inline scene::Scene wall_on_a_light(int strips) {
  scene::Scene scene;
  Mat4 upright(1);  // facing +x
  upright[0] = Vec4(0, 1, 0, 0);
  upright[1] = Vec4(1, 0, 0, 0);
  upright[3] = Vec4(0, 1, 0, 1);
  scene::add(scene, scene::quad(1), scene::diffuse(Rgb(0.5f)), upright);
  for (int i = 0; i < strips; ++i) {
    const float far = std::exp2(static_cast<float>(-i)), near = i + 1 < strips ? 0.5f * far : 0;
    Mat4 transform(1);
    transform[0][0] = 0.5f * (far - near);
    transform[3] = Vec4(0.5f * (far + near), 0, 0, 1);
    Material light = scene::diffuse(Rgb(0), Rgb(1 / (far - near)));
    light.double_sided = false;
    scene::add(scene, scene::quad(1), light, transform);
  }
  return scene;
}

inline render::Document wall_on_a_light(const TestContext& test, int strips) {
  // The camera sees the wall from the floor up, and nothing of the light.
  auto d =
      test.document(wall_on_a_light(strips), look_at({3, 0.5f, 0}, {0, 0.5f, 0}, {0, 1, 0}, 2 * std::atan(0.5f / 3)));
  d.filter = film::FilterKind::box;
  return d;
}

// The mean over seeds; a single khat has a standard error of about 0.1.
inline double mean_khat(TestContext& test, render::Document d) {
  constexpr int kSeeds = 12;
  double sum = 0;
  for (int i = 0; i < kSeeds; ++i) {
    ++d.seed;
    sum += test.tail(d, 64).khat.value_or(0);
  }
  return sum / kSeeds;
}

inline void light_that_touches_a_wall(TestContext& test) {
  const auto uniform = wall_on_a_light(test, 1), growing = wall_on_a_light(test, 12);
  const std::string light_sampling = "raycast:lights=one";
  test.expect_between(light_sampling, "khat with uniform emission",
                      mean_khat(test, TestContext::with_method(uniform, light_sampling)), -1, 0.3);
  test.expect_near(light_sampling, "khat with emission growing towards the edge",
                   mean_khat(test, TestContext::with_method(growing, light_sampling)), 1, 0.15);
  test.expect_between("path", "khat with uniform emission", mean_khat(test, TestContext::with_method(uniform, "path")),
                      -1, 0.3);
}

inline constexpr Case kLightThatTouchesAWall{
    .name = "light-that-touches-a-wall",
    .kind = Kind::heavy_tails,
    .theory =
        "Area sampling of a light that touches a surface has infinite variance near the edge. Solid angle "
        "sampling and combined sampling are bounded. Exceptions are strips too narrow to be sampled by "
        "solid angle, whose tail index is 1",
    .run = light_that_touches_a_wall};

}  // namespace etendue::stress
