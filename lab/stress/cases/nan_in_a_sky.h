// An environment map with one texel that is NaN.   [IEEE 754]
#pragma once
#include <limits>

#include "image/image.h"
#include "stress/case.h"

namespace etendue::stress {

inline void nan_in_a_sky(TestContext& test) {
  scene::Scene scene = uniform_sky();
  auto map = std::make_shared<image::Image>();
  map->width = 16;
  map->height = 8;
  map->channels = 3;
  map->type = image::PixelType::float32;
  map->floats.assign(16 * 8 * 3, 1.0f);
  map->floats[3 * (4 * 16 + 8)] = std::numeric_limits<float>::quiet_NaN();
  scene.environment.map = map;
  const auto d = test.document(std::move(scene), look_at({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2.5f));
  for (const auto& method : unbiased_integrators()) {
    const film::Film film = test.render(TestContext::with_method(d, method), 4);
    test.expect_between(method, "discarded samples", static_cast<double>(film.invalid_samples().total()), 1, 4096);
    test.expect_between(method, "mean", film::mean_of(film).value, 0.5, 1);
  }
}

inline constexpr Case kNanInASky{
    .name = "nan-in-a-sky",
    .kind = Kind::invalid_numbers,
    .theory =
        "A NaN texel invalidates only the samples that hit it: they are counted and discarded, and "
        "the mean stays finite",
    .run = nan_in_a_sky};

}  // namespace etendue::stress
