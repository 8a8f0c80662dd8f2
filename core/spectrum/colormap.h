// Colours for numbers: viridis (S. van der Walt and N. Smith 2015), legible without colour vision and in grey.
#pragma once
#include "spectrum/rgb.h"

namespace etendue {

// Display-encoded colour of x in [0, 1], clamped outside.
Rgb viridis(float x);

// Display-encoded colour of x in [-1, 1], clamped outside: blue below, white at zero, red above, as dark on both sides.
Rgb diverging_color(float x);

}  // namespace etendue
