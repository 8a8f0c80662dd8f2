// A furnace with infinite emission.   [IEEE 754]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void infinite_emission(TestContext& test) {
  scene::Scene scene;
  scene::add(scene, scene::cube(1, true), scene::diffuse(Rgb(0.5f), Rgb(kInfinity)));
  const auto d = test.document(std::move(scene), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  for (const auto& method : unbiased_integrators()) {
    const film::Film film = test.render(TestContext::with_method(d, method), 2);
    const double pixels = static_cast<double>(film.width()) * film.height();
    test.expect_near(method, "discarded samples", static_cast<double>(film.invalid_samples().total()), 2 * pixels, 0);
    test.expect_zero(method, "mean", film::mean_of(film).value);
  }
}

inline constexpr Case kInfiniteEmission{
    .name = "infinite-emission",
    .kind = Kind::invalid_numbers,
    .theory = "Samples that are not finite are counted and discarded, so the image stays finite",
    .run = infinite_emission};

}  // namespace etendue::stress
