// A light above a large floor of which the camera sees a small part.   [Lang, sec. 9.2.2]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void view_of_a_small_part(TestContext& test) {
  constexpr double kHeight = 10;  // of the light
  constexpr double kSide = 3;     // of the visible area
  scene::Scene scene;
  scene::add(scene, scene::quad(1000), scene::diffuse(Rgb(0.5f)));
  Material emitter = scene::diffuse(Rgb(0), Rgb(100));
  emitter.double_sided = false;
  Mat4 transform(1);
  transform[0][0] = 0.1f;
  transform[1][1] = -1;
  transform[2][2] = -0.1f;
  transform[3] = Vec4(0, static_cast<float>(kHeight), 0, 1);
  scene::add(scene, scene::quad(1), emitter, transform);
  const auto field = static_cast<float>(2 * std::atan(0.5 * kSide / 9));
  auto d = test.document(std::move(scene), look_at({0, 9, 0}, {0, 0, 0}, {0, 0, 1}, field));
  d.filter = film::FilterKind::box;
  constexpr uint32_t kSamples = 128;
  const auto with = [&](const char* method) {
    return TestContext::with_method(d, std::string(method) + ":sampler=random");
  };
  const double mean = test.mean(with("path"), kSamples).value;
  test.expect_mean("light", "mean", test.mean(with("light"), kSamples), mean);
  const auto relative_variance = [&](const char* method) {
    return kSamples * test.squared_error(with(method), kSamples) / sqr(mean);
  };
  const std::string point = "variance / mean^2 of a sample";
  for (const char* method : {"path", "bdpt"}) test.expect_between(method, point, relative_variance(method), 0, 0.02);
  test.expect_near("light", point, relative_variance("light"), double{kPi} * sqr(kHeight / kSide) - 1, 0.25);
}

inline constexpr Case kViewOfASmallPart{
    .name = "view-of-a-small-part",
    .kind = Kind::heavy_tails,
    .theory =
        "Only a fraction (area in view) / (pi h^2) of the light paths contributes to the image, and the "
        "relative variance is its inverse. Paths from the camera hardly deviate",
    .run = view_of_a_small_part};

}  // namespace etendue::stress
