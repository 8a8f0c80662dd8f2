// Error of an image against a reference, on linear pixels.
//
//   mse     mean of (x - r)^2                 relmse  mean of (x - r)^2 / (r^2 + 0.01)
//   rmse    root of mse                       mae     mean of |x - r|
//   smape   mean of |x - r| / ((|x| + |r|) / 2), zero where both are zero
//   psnr    10 log10(peak^2 / mse) in dB, peak the largest reference value; infinite for equal images
//   bias    mean of x - r
// All means are over pixels and channels, in double precision.
#pragma once
#include <span>

#include "base/result.h"
#include "film/error_measure.h"
#include "image/image.h"

namespace etendue::metrics {

struct Metrics {
  double mse = 0, rmse = 0, relmse = 0, mae = 0, smape = 0, psnr = 0, bias = 0;
};

// Compares values in the same order. Values that are not finite make the results not finite.
Metrics metrics_of(std::span<const float> image, std::span<const float> reference);

// The mean over pixels and channels of the squared difference of displayed values (film/error_measure.h).
double displayed_mse(std::span<const float> image, std::span<const float> reference,
                     const film::DisplayTransform& display);

// Compares two beauty layers of equal size; anything else is an input error. A pixel that is not finite is an input
// error too, because a mean over the remaining pixels would hide it.
Result<Metrics> compare(const image::LayeredImage& image, const image::LayeredImage& reference);

}  // namespace etendue::metrics
