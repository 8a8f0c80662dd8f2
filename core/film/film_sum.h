// Sums of films.
#pragma once
#include "film/film.h"

namespace etendue::film {

// Adds the samples of `from`, which has the same size, to `to`. The sums stay exact. Tile variances are not added.
void add_film(Film& to, const Film& from);

}  // namespace etendue::film
