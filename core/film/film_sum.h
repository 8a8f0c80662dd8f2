// Sums of films.
#pragma once
#include "film/film.h"

namespace etendue::film {

// Adds the samples of `from`, which has the same size, to `to`. The sums stay exact. Tile variances are not added.
void add_film(Film& to, const Film& from);
// The same in steps: the pixels of the rows [first, end), which may be done in parallel, and the invalid samples.
void add_rows(Film& to, const Film& from, int first, int end);
void add_invalid_samples(Film& to, const Film& from);

}  // namespace etendue::film
