#include "film/film_crop.h"

namespace etendue::film {

Film cropped(const Film& film, int x, int y, int width, int height) {
  Film part(width, height);
  // Its presence decides how the half-buffers are weighted.
  if (film.tile_variance()) part.begin_tile_variance(0);
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      for (uint32_t half = 0; half < kHalfBuffers; ++half)
        part.add_sum(i, j, half, film.sum(x + i, y + j, half), film.half_buffer_samples(x + i, y + j, half));
  return part;
}

}  // namespace etendue::film
