// The films of previews: one for each scale is kept, because allocating a large one takes longer than clearing it.
#pragma once
#include <functional>
#include <map>

#include "film/film.h"
#include "render/thread_pool.h"

namespace etendue::render {

class PreviewFilms {
 public:
  // An empty film for previews at this scale. Null if `keep_going` stopped its preparation.
  film::Film* cleared(ThreadPool& workers, int scale, int width, int height, const std::function<bool()>& keep_going) {
    film::Film& film = films_[scale];
    if (film.width() != width || film.height() != height) {
      film = film::Film(width, height);
      return &film;
    }
    const auto clear_rows = [&](int first, int end) { film.clear_rows(first, end); };
    if (!workers.run_ranges(height, clear_rows, keep_going)) return nullptr;
    film.set_invalid_samples({});
    film.tile_variance().reset();
    return &film;
  }

 private:
  std::map<int, film::Film> films_;
};

}  // namespace etendue::render
