// What a rendering continues from, and what it records besides the film.
#pragma once
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "film/film.h"
#include "film/tail_state.h"

namespace etendue::integrator {
class PathLayerRecording;
}

namespace etendue::render {

struct ResumePoint {
  film::Film film;
  std::vector<std::byte> integrator_state;  // empty if the integrator has none (integrator::RenderState::state)
  std::vector<film::TailState> tails = {};  // of the tiles (TailStatistics); empty if they are not known
  double seconds = 0;  // of rendering so far; time limits and statistics include them
  // Receives layers of the paths (integrator/path/path_layers.h) of the samples that are taken; null: none.
  std::shared_ptr<integrator::PathLayerRecording> layers = nullptr;

  ResumePoint(film::Film film_, std::vector<std::byte> integrator_state_ = {},  // NOLINT(google-explicit-constructor)
              std::vector<film::TailState> tails_ = {})
      : film(std::move(film_)), integrator_state(std::move(integrator_state_)), tails(std::move(tails_)) {}
};

}  // namespace etendue::render
