// The mean radiance of an image with its standard error
#pragma once
#include "film/film.h"

namespace etendue::film {

struct Mean {
  double value = 0;           // mean over pixels and channels
  double standard_error = 0;  // estimated from the variance over pixels, which are assumed to be independent
  double variance = 0;        // over pixels, of the mean of the channels
};
Mean mean_of(const Film& film);

}  // namespace etendue::film
