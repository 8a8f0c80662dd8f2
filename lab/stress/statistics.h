// Statistics of noise and of samplers for the cases about correlation.
#pragma once
#include <cstdint>
#include <string>

#include "film/film.h"

namespace etendue::stress {

// The correlation coefficient of the noise of two images of a uniform scene; the second is shifted to the left by
// `shift` pixels.
double noise_correlation(const film::Film& a, const film::Film& b, int shift);
// The variance over the pixels of the average of two images of a uniform scene.
double variance_of_mean(const film::Film& a, const film::Film& b);
// The fraction of pixels whose first 64 samples leave at least half of 8 x 8 cells empty, in this dimension and the
// next.
double clumped_pixel_fraction(const std::string& sampler, uint32_t dimension);

}  // namespace etendue::stress
