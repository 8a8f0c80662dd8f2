// Walks from the lights that have to end on a lens, which shrinks.                                 digest 8-10: F2, S19
#pragma once
#include "scene/builtin/integrating_sphere.h"
#include "stress/case.h"

namespace etendue::stress {

inline void lens_too_small_to_hit(Lab& lab) {
  constexpr double kShare = 0.1, kAlbedo = 0.5, kMean = kAlbedo * kShare / (1 - kAlbedo);
  constexpr uint32_t kSamples = 1024;
  auto d = lab.document(scene::integrating_sphere(kShare, kAlbedo), scene::integrating_sphere_camera());
  d.width = d.height = 8;
  d.filter = film::FilterKind::box;
  d = Lab::with_method(d, "light-pure:sampler=random:max-depth=12");
  lab.expect_zero("light-pure", "pinhole", lab.mean(d, 4).value);
  d.camera.focus_distance = 1;
  double first = 0;
  for (const float radius : {0.4f, 0.2f}) {
    d.camera.lens_radius = radius;
    const film::Mean found = lab.mean(d, kSamples);
    const std::string point = "radius " + number(double{radius});
    lab.expect_near("light-pure", point, found.value, kMean, Lab::kSigmas * found.standard_error / kMean);
    const double scaled = found.variance * double{sqr(radius)};
    if (first == 0) first = scaled;
    lab.expect_near("light-pure", point + ": variance times squared radius, over the first", scaled / first, 1, 0.5);
  }
}

inline constexpr Case kLensTooSmallToHit{
    "lens-too-small-to-hit", Kind::missing_paths,
    "A walk falls onto the lens with a probability that shrinks as its area, and the variance grows as one over it; "
    "onto a pinhole it never falls",
    lens_too_small_to_hit};

}  // namespace etendue::stress
