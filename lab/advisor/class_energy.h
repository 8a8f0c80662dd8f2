// The energy that a class of paths contributes to an image, with its standard error.
//
// The random numbers of different pixels are independent, so the variance of the mean over the image is the sum of the
// pixel variances. Each pixel variance is estimated from the two half-buffers of the film; the sum has as many degrees
// of freedom as there are pixels.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "film/error_measure.h"
#include "film/film.h"

namespace etendue::advisor {

struct ClassEnergy {
  double mean = 0, standard_error = 0;  // luminance, averaged over the pixels
  // The radiance of the pixels in each half-buffer, three numbers per pixel.
  struct HalfBuffers {
    std::vector<float> first, second;
  };
  std::shared_ptr<const HalfBuffers> image;  // null if no sample found any energy

  bool found() const { return mean > 0; }
  // True if too few samples found energy for a reliable mean.
  bool uncertain() const { return standard_error > kMaxRelativeError * mean; }
  static constexpr double kMaxRelativeError = 0.2;
};

// The energy in a film with the same number of samples in both half-buffers.
ClassEnergy class_energy(const film::Film& film);

// The root mean square over pixels and channels of the sum of these images, without the contribution of noise: the
// expectation of the product of two half-buffers is the square of the mean. It is the RMSE of an image that lacks these
// classes. Images of larger pixels give a smaller value. All images have the same size.
double rms_of(std::span<const ClassEnergy> energies);

// The mean square of the sum, divided per pixel by the squared radiance of the complete image plus 0.01, as in relMSE.
double relative_square_of(std::span<const ClassEnergy> energies, const ClassEnergy& total);

// The mean square of the change of the displayed values if the sum is missing from the complete image.
double displayed_square_of(std::span<const ClassEnergy> energies, const ClassEnergy& total,
                           const film::DisplayTransform& display);

}  // namespace etendue::advisor
