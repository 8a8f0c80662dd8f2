// Emptying films on all workers.
#pragma once
#include <functional>
#include <map>

#include "film/film.h"
#include "render/thread_pool.h"

namespace etendue::render {

// Makes a film of this size that has no samples. It keeps its memory if it has the size already: allocating a large one takes
// longer. False if `keep_going` stopped it; it then has to be called again before sampling.
bool make_empty(film::Film& film, int width, int height, ThreadPool& workers, const std::function<bool()>& keep_going);

// The films of previews, one for each scale.
class PreviewFilms {
 public:
  // An empty film; null if `keep_going` stopped its preparation.
  film::Film* empty_film(int scale, int width, int height, ThreadPool& workers,
                         const std::function<bool()>& keep_going) {
    film::Film& film = films_[scale];
    return make_empty(film, width, height, workers, keep_going) ? &film : nullptr;
  }
  // In bytes.
  size_t memory() const {
    size_t bytes = 0;
    for (const auto& [scale, film] : films_) bytes += film.memory();
    return bytes;
  }

 private:
  std::map<int, film::Film> films_;
};

}  // namespace etendue::render
