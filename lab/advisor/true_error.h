// The true error of an image, estimated from an independent rendering of the same scene.
//
// With a and b the half-buffers of the independent rendering and x the image, the expectation of (x - a)(x - b) is the
// squared error of x. The noise of a and b is independent, so it does not bias the product, whatever its size.
#pragma once
#include <span>

#include "film/film.h"

namespace etendue::advisor {

// A mean square over pixels and channels, and its standard error due to the noise of the other rendering.
struct MeanSquare {
  double value = 0, standard_error = 0;

  // The root of the value, and the interval of `sigmas` standard errors around it; negative squares are clamped to
  // zero.
  double root() const;
  film::Interval root_interval(double sigmas) const;
};

struct TrueError {
  // `relative` divides by the squared mean of both half-buffers plus 0.01, as in relMSE. The divisor is correlated with
  // the products, so the value is approximate where the other rendering is noisy.
  MeanSquare absolute, relative;
};

// `image` has three numbers for each pixel of the film.
TrueError true_error(std::span<const float> image, const film::Film& other);

}  // namespace etendue::advisor
