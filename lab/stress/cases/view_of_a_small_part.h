// A lamp over a wide floor, of which the camera sees a small part.                              digest 8-10: F8, L17278
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void view_of_a_small_part(Lab& lab) {
  constexpr double kHeight = 10, kSide = 3;  // of what is seen
  scene::Scene scene;
  scene::add(scene, scene::quad(1000), scene::diffuse(Rgb(0.5f)));
  Material lamp = scene::diffuse(Rgb(0), Rgb(100));
  lamp.double_sided = false;
  Mat4 place(1);
  place[0][0] = 0.1f, place[1][1] = -1, place[2][2] = -0.1f, place[3] = Vec4(0, static_cast<float>(kHeight), 0, 1);
  scene::add(scene, scene::quad(1), lamp, place);
  const auto field = static_cast<float>(2 * std::atan(0.5 * kSide / 9));
  auto d = lab.document(std::move(scene), look_at({0, 9, 0}, {0, 0, 0}, {0, 0, 1}, field));
  d.filter = film::FilterKind::box;
  constexpr uint32_t kSamples = 128;
  const auto by = [&](const char* method) { return Lab::with_method(d, std::string(method) + ":sampler=random"); };
  const double mean = lab.mean(by("path"), kSamples).value;
  lab.expect_mean("light", "mean", lab.mean(by("light"), kSamples), mean);
  const auto relative = [&](const char* method) {
    return kSamples * lab.squared_error(by(method), kSamples) / sqr(mean);
  };
  const std::string point = "variance / mean^2 of a sample";
  for (const char* method : {"path", "bdpt"}) lab.expect_between(method, point, relative(method), 0, 0.02);
  lab.expect_near("light", point, relative("light"), double{kPi} * sqr(kHeight / kSide) - 1, 0.25);
}

inline constexpr Case kViewOfASmallPart{
    "view-of-a-small-part", Kind::heavy_tails,
    "Walks from the light go everywhere: of one in pi h^2 over the area in view anything is seen, and that is the "
    "variance of a pixel, while connections from the camera hardly deviate",
    view_of_a_small_part};

}  // namespace etendue::stress
