#include "render/film_clearing.h"

namespace etendue::render {

bool make_empty(film::Film& film, int width, int height, ThreadPool& workers, const std::function<bool()>& keep_going) {
  if (film.width() != width || film.height() != height) {
    film = film::Film();  // frees the memory of the old film first
    film = film::Film(width, height);
    return true;
  }
  const auto clear_rows = [&](int first, int end) { film.clear_rows(first, end); };
  if (!workers.run_ranges(height, clear_rows, keep_going)) return false;
  film.set_invalid_samples({});
  film.tile_variance().reset();
  return true;
}

}  // namespace etendue::render
