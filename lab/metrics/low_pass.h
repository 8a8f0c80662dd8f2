// Low-pass filtered images: what an eye or a display sees of errors from a distance.
#pragma once
#include "image/image.h"

namespace etendue::metrics {

// The beauty layer convolved with a Gaussian of the standard deviation `sigma`, in pixels, cut at 4 sigma. Pixels outside
// the image repeat the nearest edge pixel. Other layers are left out.
image::LayeredImage low_passed(const image::LayeredImage& image, double sigma);

}  // namespace etendue::metrics
