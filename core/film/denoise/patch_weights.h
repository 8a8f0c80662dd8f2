// Weights of non-local means: similarity of the patches around two pixels [Rousselle et al. 2012]
#pragma once
#include <span>
#include <vector>

#include "film/denoise/padded_plane.h"

namespace etendue::film {

inline constexpr int kPatchRadius = 2;

struct GuideImage {
  std::span<const PaddedPlane> channels;
  const PaddedPlane* variance = nullptr;  // mean of the channels
  float min_variance = 0;                 // added to the variance, against division by zero
};

// Weights of the pixels of a tile for the neighbours at all offsets (dx, dy) with |dx|, |dy| <= radius: exp(-d), where d
// is the mean squared difference of the patches, minus the part that noise explains, in units of the variance. Offsets
// are in the order of rows; each has kTilePixels weights. `valid` is 0 for pixels that must not be used, else 1. The
// radius and kPatchRadius together must not exceed kBorder.
void patch_weights(const GuideImage& guide, const PaddedPlane& valid, TilePosition tile, int radius,
                   std::vector<float>& weights);

}  // namespace etendue::film
