// The image of a film
#pragma once
#include "film/film.h"
#include "image/image.h"

namespace etendue::film {

// The mean radiance of every pixel: three values per pixel, row by row.
std::vector<float> radiance_of(const Film& film);

// The beauty layer, and the layer "variance" with the squared standard error of each channel.
image::LayeredImage layered_image_of(const Film& film);

}  // namespace etendue::film
