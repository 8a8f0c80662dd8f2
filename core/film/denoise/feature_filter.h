// Removal of noise from features (depth of field, motion blur, edges) before the regression
#pragma once
#include <array>
#include <vector>

#include "film/denoise/denoise_input.h"
#include "film/denoise/padded_plane.h"

namespace etendue::film {

// Mean of both half-buffers of each feature after filtering by non-local means, with the weights of the other
// half-buffer. Features without noise keep their values. Zero if there are no features.
std::vector<PaddedPlane> filtered_features(const DenoiseInput& input, const ForEach& for_each);

}  // namespace etendue::film
