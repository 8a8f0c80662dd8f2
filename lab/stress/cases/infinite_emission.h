// A furnace whose emission is infinite.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void infinite_emission(Lab& lab) {
  scene::Scene scene;
  scene::add(scene, scene::cube(1, true), scene::diffuse(Rgb(0.5f), Rgb(kInfinity)));
  const auto d = lab.document(std::move(scene), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  for (const auto& method : unbiased_methods()) {
    const film::Film film = lab.render(Lab::with_method(d, method), 2);
    const double pixels = static_cast<double>(film.width()) * film.height();
    lab.expect_near(method, "samples refused", static_cast<double>(film.invalid_samples().total()), 2 * pixels, 0);
    lab.expect_zero(method, "mean", film::mean_of(film).value);
  }
}

inline constexpr Case kInfiniteEmission{
    "infinite-emission", Kind::bad_numbers,
    "A sample that is no number is counted and left out: the picture stays finite and the count is shown",
    infinite_emission};

}  // namespace etendue::stress
