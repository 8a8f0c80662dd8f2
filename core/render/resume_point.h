// What a rendering continues from.
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

#include "film/film.h"
#include "film/tail_state.h"

namespace etendue::render {

struct ResumePoint {
  film::Film film;
  std::vector<std::byte> integrator_state;  // empty if the integrator has none (integrator::RenderState::state)
  std::vector<film::TailState> tails = {};  // of the tiles (TailStatistics); empty if they are not known

  ResumePoint(film::Film film_, std::vector<std::byte> integrator_state_ = {},  // NOLINT(google-explicit-constructor)
              std::vector<film::TailState> tails_ = {})
      : film(std::move(film_)), integrator_state(std::move(integrator_state_)), tails(std::move(tails_)) {}
};

}  // namespace etendue::render
