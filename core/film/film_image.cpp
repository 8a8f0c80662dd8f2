#include "film/film_image.h"

namespace etendue::film {
namespace {

template <class F>
std::vector<float> collect_pixels(const Film& film, F&& color_of) {
  std::vector<float> rgb;
  rgb.reserve(film.pixels().size() * 3);
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const Rgb c = color_of(x, y);
      rgb.insert(rgb.end(), {c.r, c.g, c.b});
    }
  return rgb;
}

}  // namespace

std::vector<float> radiance_of(const Film& film) {
  return collect_pixels(film, [&](int x, int y) { return film.mean(x, y); });
}

image::LayeredImage layered_image_of(const Film& film) {
  image::LayeredImage image{.width = film.width(), .height = film.height()};
  image.layers.push_back({"", {"R", "G", "B"}, radiance_of(film)});
  image.layers.push_back(
      {"variance", {"R", "G", "B"}, collect_pixels(film, [&](int x, int y) { return film.variance_of_mean(x, y); })});
  return image;
}

}  // namespace etendue::film
