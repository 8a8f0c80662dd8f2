// Rectangular parts of a film.
#pragma once
#include "film/film.h"

namespace etendue::film {

// The pixels [x, x + width) x [y, y + height) of a film, with the same means and variances. The rectangle must lie in
// the film. Sums are rounded to double precision.
Film cropped(const Film& film, int x, int y, int width, int height);

}  // namespace etendue::film
