// Weighted least squares around several neighbouring pixels at once
#pragma once
#include <array>
#include <span>

#include "film/denoise/denoise_input.h"
#include "film/denoise/padded_plane.h"

namespace etendue::film {

inline constexpr int kRegressionRadius = 6;  // of the windows, pixels
inline constexpr size_t kRegressionLanes = 16;
using RegressionLanes = std::array<float, kRegressionLanes>;

// The weights of the second bandwidth are the fourth powers of those of the first one, which halves the bandwidth.
inline constexpr size_t kBandwidths = 2;

struct RegressionPlanes {
  std::span<const PaddedPlane> features;  // kDenoiseFeatures planes
  std::span<const PaddedPlane> colors;    // three planes
};

// Fitted values at the pixels, for each bandwidth and channel.
using RegressionResult = std::array<std::array<RegressionLanes, 3>, kBandwidths>;

// Fits the colours in windows around kRegressionLanes pixels of a row, from (x, y) on, by a constant and one slope per
// feature. `weights` has the weights of these pixels for each offset in the order of patch_weights; consecutive offsets
// are kTilePixels apart. Slopes are damped where features hardly vary. A pixel without valid neighbours keeps its value.
void fit_windows(const RegressionPlanes& planes, int x, int y, const float* weights, RegressionResult& result);

}  // namespace etendue::film
