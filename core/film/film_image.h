// A film as a picture with what is known of its error.
#pragma once
#include "film/film.h"
#include "image/image.h"

namespace etendue::film {

// The radiance of every pixel, three numbers each, row by row.
std::vector<float> radiance_of(const Film& film);

// The beauty layer, and a layer "variance": the squared standard error of each channel.
image::LayeredImage layered_image_of(const Film& film);

}  // namespace etendue::film
