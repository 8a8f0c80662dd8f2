// How far an image is from a reference, on linear pixels.                             design: accuracy
//
//   mse     mean of (x - r)^2                 relmse  mean of (x - r)^2 / (r^2 + 0.01)
//   rmse    its root                          mae     mean of |x - r|
//   smape   mean of |x - r| / ((|x| + |r|) / 2), zero where both are zero
//   psnr    10 log10(peak^2 / mse) in dB, peak the largest reference value; infinite for equal images
//   bias    mean of x - r
// All means are over pixels and channels, in double.
#pragma once
#include <span>

#include "base/result.h"
#include "image/image.h"

namespace etendue::metrics {

struct Metrics {
  double mse = 0, rmse = 0, relmse = 0, mae = 0, smape = 0, psnr = 0, bias = 0;
};

// Of numbers in the same order. What is not finite makes them so.
Metrics metrics_of(std::span<const float> picture, std::span<const float> reference);

// Two beauty layers of equal size; anything else is an input error. A pixel that is not finite in either is an input
// error too: a mean over the rest would hide it.
Result<Metrics> compare(const image::LayeredImage& picture, const image::LayeredImage& reference);

}  // namespace etendue::metrics
