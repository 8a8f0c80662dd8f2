// The dimensions of the sampler that the samples of a pixel draw, as a table.
#pragma once
#include <optional>
#include <string>
#include <utility>

#include "viewer/state/app_state.h"
#include "viewer/tasks/pixel_statistics.h"

namespace etendue::viewer {

// One row for the camera and one for each path vertex, with the share of the samples that draw each random number. A
// click on a number selects its two dimensions, whose names are returned.
std::optional<std::pair<std::string, std::string>> drawn_dimensions_table(const UiContext& ui,
                                                                          const PixelStatistics& statistics,
                                                                          uint32_t vertices);

}  // namespace etendue::viewer
