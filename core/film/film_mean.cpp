#include "film/film_mean.h"

namespace etendue::film {

Mean mean_of(const Film& film) {
  double sum = 0, squares = 0;
  const double n = static_cast<double>(film.width()) * film.height();
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const double v = average(film.mean(x, y));
      sum += v;
      squares += v * v;
    }
  Mean mean;
  mean.value = sum / n;
  mean.variance = std::max(0.0, squares / n - mean.value * mean.value) * n / (n - 1);
  mean.standard_error = std::sqrt(mean.variance / n);
  return mean;
}

}  // namespace etendue::film
