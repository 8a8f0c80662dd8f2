// The standard error of each pixel as a false-colour image.
#pragma once
#include <vector>

#include "film/film.h"

namespace etendue::viewer {

struct ErrorLayer {
  std::vector<Rgb> pixels;  // linear colours; black where the error is zero or unknown
  double low = 0;           // radiance at the ends of the colour scale, which is logarithmic
  double high = 0;
};

// The standard error of the mean of each pixel, row by row: the root of its square averaged over the channels and over
// 5 x 5 pixels. 0 where a half-buffer has no sample.
std::vector<double> pixel_errors(const film::Film& film);

// The error of a pixel is estimated from the two half-buffers of the film, which gives one degree of freedom per pixel;
// it is therefore averaged over 5 x 5 pixels. The scale ends at the 99th percentile and spans five stops.
ErrorLayer error_layer(const film::Film& film);

}  // namespace etendue::viewer
