// Where a picture errs: the standard error of each pixel, as colours.
#pragma once
#include <string>
#include <vector>

#include "film/film.h"

namespace etendue::viewer {

struct ErrorLayer {
  std::vector<Rgb> pixels;   // linear, made to be looked at; black where nothing is known or nothing errs
  double low = 0, high = 0;  // radiance at both ends of the scale, which is logarithmic
};

// From the two halves of the film, which have one degree of freedom in a pixel: means over 5 x 5 pixels. The scale ends
// where all but 1 % of the pixels lie, and spans five stops.
ErrorLayer error_layer(const film::Film& film);

}  // namespace etendue::viewer
