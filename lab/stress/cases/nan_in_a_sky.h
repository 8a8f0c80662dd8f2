// A map all around with one texel that is no number.
#pragma once
#include <limits>

#include "image/image.h"
#include "stress/case.h"

namespace etendue::stress {

inline void nan_in_a_sky(Lab& lab) {
  scene::Scene scene = sky();
  auto map = std::make_shared<image::Image>();
  map->width = 16, map->height = 8, map->channels = 3, map->type = image::PixelType::float32;
  map->floats.assign(16 * 8 * 3, 1.0f);
  map->floats[3 * (4 * 16 + 8)] = std::numeric_limits<float>::quiet_NaN();
  scene.environment.map = map;
  const auto d = lab.document(std::move(scene), look_at({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2.5f));
  for (const auto& method : unbiased_methods()) {
    const film::Film film = lab.render(Lab::with_method(d, method), 4);
    lab.expect_between(method, "samples refused", static_cast<double>(film.invalid_samples().total()), 1, 4096);
    lab.expect_between(method, "mean", film::mean_of(film).value, 0.5, 1);
  }
}

inline constexpr Case kNanInASky{"nan-in-a-sky", Kind::bad_numbers,
                                 "One texel that is no number spoils the samples that meet it, not the picture: they "
                                 "are counted, the mean stays finite",
                                 nan_in_a_sky};

}  // namespace etendue::stress
