// How far a picture is from the truth, by another rendering of it.
//
// With a and b the halves of an independent rendering and x the picture, (x - a)(x - b) has (x - truth)^2 as its
// expectation: the rendering's own noise is in no product twice, so it takes nothing off and adds nothing, however
// little there is of it.
#pragma once
#include <span>

#include "film/film.h"

namespace etendue::advisor {

// A mean square over pixels and channels, and the standard error that the other rendering's noise gives it.
struct MeanSquare {
  double value = 0, standard_error = 0;

  // Roots of the value and of an interval of so many standard errors around it, none below zero.
  double root() const;
  film::Interval root_interval(double sigmas) const;
};

struct TrueError {
  // Relative: over the square of the mean of both halves plus 0.01, as relMSE. That mean knows of the products: where
  // the other rendering is noisy, the value is a rough one.
  MeanSquare absolute, relative;
};

// `picture` has three numbers for each pixel of the film.
TrueError true_error(std::span<const float> picture, const film::Film& other);

}  // namespace etendue::advisor
