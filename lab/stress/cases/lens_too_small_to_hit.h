// Light paths that must hit the lens, whose radius decreases.   [Lang, sec. 9.2.1, Remark 9.11]
#pragma once
#include "scene/builtin/integrating_sphere.h"
#include "stress/case.h"

namespace etendue::stress {

inline void lens_too_small_to_hit(TestContext& test) {
  constexpr double kShare = 0.1, kAlbedo = 0.5, kMean = kAlbedo * kShare / (1 - kAlbedo);
  constexpr uint32_t kSamples = 1024;
  auto d = test.document(scene::integrating_sphere(kShare, kAlbedo), scene::integrating_sphere_camera());
  d.width = d.height = 8;
  d.filter = film::FilterKind::box;
  d = TestContext::with_method(d, "light-pure:sampler=random:max-depth=12");
  test.expect_zero("light-pure", "pinhole", test.mean(d, 4).value);
  d.camera.focus_distance = 1;
  double first = 0;
  for (const float radius : {0.4f, 0.2f}) {
    d.camera.lens_radius = radius;
    const film::Mean mean = test.mean(d, kSamples);
    const std::string point = "radius " + number(double{radius});
    test.expect_near("light-pure", point, mean.value, kMean, TestContext::kSigmas * mean.standard_error / kMean);
    const double scaled = mean.variance * double{sqr(radius)};
    if (first == 0) first = scaled;
    test.expect_near("light-pure", point + ": variance times squared radius, over the first", scaled / first, 1, 0.5);
  }
}

inline constexpr Case kLensTooSmallToHit{
    .name = "lens-too-small-to-hit",
    .kind = Kind::missing_paths,
    .theory =
        "A light path hits the lens with a probability proportional to its area, so the variance "
        "grows as 1 / area, and it never hits a pinhole",
    .run = lens_too_small_to_hit};

}  // namespace etendue::stress
