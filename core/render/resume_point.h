// What a rendering continues from.
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

#include "film/film.h"

namespace etendue::render {

struct ResumePoint {
  film::Film film;
  std::vector<std::byte> integrator_state;  // empty if the integrator has none (integrator::RenderState::state)

  ResumePoint(film::Film film_, std::vector<std::byte> integrator_state_ = {})  // NOLINT(google-explicit-constructor)
      : film(std::move(film_)), integrator_state(std::move(integrator_state_)) {}
};

}  // namespace etendue::render
