// A glossy metal floor that narrows, under a small light that it mirrors.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void narrow_lobe_and_small_light(Lab& lab) {
  for (const float roughness : {0.05f, 0.2f, 0.6f}) {
    scene::Scene scene;
    Material floor;
    floor.metallic = 1, floor.roughness = roughness;
    scene::add(scene, scene::quad(10), floor);
    Material light = scene::diffuse(Rgb(0), Rgb(1));
    Mat4 place(1);
    place[3] = Vec4(-1, 1, 0, 1);
    scene::add(scene, scene::sphere(0.05f, 24, false), light, place);
    const auto d = lab.document(std::move(scene), telescope({1, 1, 0}, {0, 0, 0}));
    for (const char* heuristic : {"balance", "power", "maximum"}) {
      const std::string method = std::string("path:sampler=random:heuristic=") + heuristic;
      const film::Mean mean = lab.mean(Lab::with_method(d, method), 64);
      lab.expect_between(method, "variance / mean^2 of a sample at roughness " + number(roughness),
                         64 * mean.variance / (mean.value * mean.value), 0, 4);
    }
  }
}

inline constexpr Case kNarrowLobeAndSmallLight{
    "narrow-lobe-and-small-light", Kind::heavy_tails,
    "Either technique alone explodes at one end of the sweep; combined by their densities neither may",
    narrow_lobe_and_small_light};

}  // namespace etendue::stress
