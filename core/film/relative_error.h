// Estimate of relMSE, the mean of (x - r)^2 / (r^2 + 0.01) over pixels and channels, without the true radiance r.
//
// The squared error in the numerator is estimated from the half-buffers (error.h). The denominator needs the true
// radiance. The pixel's own mean is not suitable: if few bright samples cause the noise, the mean is highest where the
// error is largest, and relMSE is underestimated by a third. r is therefore estimated from other pixels, as in non-local
// means [Buades et al. 2005; Rousselle et al. 2012]: the mean of nearby pixels whose own eight neighbours equal those of
// this pixel within their noise. The value of the pixel itself does not influence the weights and has little weight in
// the mean.
//
// The interval is for the error of this image. It combines three terms: the part of the realised error that the
// half-buffers miss, as in error.h, with similar pixels as substitutes for each other; noise in the mean of the other
// pixels; and the change of the estimate if the pixel's own mean had the same weight as the others, which bounds the
// bias from similar pixels of different radiance.
#pragma once
#include <functional>
#include <optional>
#include <span>

#include "film/film.h"

namespace etendue::film {

struct RelativeError {
  double relmse = 0;
  Interval interval;
  // The standard deviation of the root of relMSE over images made with other random numbers, divided by the root.
  double root_variation = 0;
};

// Sums over the pixels of some rows.
struct RelativeErrorSum {
  double squares = 0;               // relative squared errors, over pixels and channels
  double equal_weight_squares = 0;  // the same if the pixel's own mean has the weight of a similar pixel
  double missed = 0;                // squared deviation of `squares` from the realised squared errors, divided by 4
  double divisor = 0;               // squared deviation of `squares` from noise in the means of similar pixels
  double fourth = 0;                // squares of the relative squared errors of the pixels
};

// The sums over the rows [first, end). Together with other rows they give the same result as the whole image, up to
// rounding.
RelativeErrorSum relative_error_of_rows(int width, int height, std::span<const float> rgb,
                                        std::span<const float> variance, int first, int end);
// `values` is the number of pixels times the number of channels.
RelativeError relative_error(std::span<const RelativeErrorSum> sums, double values);

// `rgb` and `variance` (of the mean) have three numbers per pixel. Takes about 0.7 us per pixel.
RelativeError relative_error(int width, int height, std::span<const float> rgb, std::span<const float> variance);

// Runs a function for consecutive ranges that cover [0, count), on any number of threads. Returns false if it was
// interrupted.
using RangeRunner = std::function<bool(int count, const std::function<void(int begin, int end)>& task)>;

// Empty until every pixel has a sample in both half-buffers, or if it was interrupted. The result does not depend on
// `run`, which by default uses the calling thread.
std::optional<RelativeError> relative_error(const Film& film, const RangeRunner& run = {});

}  // namespace etendue::film
