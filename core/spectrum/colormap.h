// Colour maps. Colours are display-encoded (sRGB).
#pragma once
#include "spectrum/rgb.h"

namespace etendue {

// The sequential map viridis [van der Walt and Smith 2015], legible with colour vision deficiencies and in grey scale.
// x is clamped to [0, 1].
Rgb viridis(float x);

// A diverging map: blue at -1, white at 0, red at 1, equally dark at both ends. x is clamped to [-1, 1].
Rgb diverging_color(float x);

}  // namespace etendue
