// The mean of a picture, as a number.
#pragma once
#include "film/film.h"

namespace etendue::film {

// Of the mean over channels, over pixels, and how far it may be off if pixels are independent: from their spread.
struct Mean {
  double value = 0, standard_error = 0;
  double variance = 0;  // of a pixel
};
Mean mean_of(const Film& film);

}  // namespace etendue::film
