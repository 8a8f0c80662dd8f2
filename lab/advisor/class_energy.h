// What a class of paths carries in a picture, with the error of that.
//
// Pixels have random numbers of their own, so the variance of the mean over pixels is the sum of theirs, each told from
// the two halves of the film: it has as many degrees of freedom as there are pixels.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "film/film.h"

namespace etendue::advisor {

struct ClassEnergy {
  double mean = 0, standard_error = 0;  // luminance, over pixels
  // The radiance of the pixels in each half of the film, three numbers each.
  struct Halves {
    std::vector<float> first, second;
  };
  std::shared_ptr<const Halves> picture;  // null where nothing was found

  bool found() const { return mean > 0; }
  // So few samples found it that its number cannot be believed.
  bool uncertain() const { return standard_error > kUncertain * mean; }
  static constexpr double kUncertain = 0.2;
};

// Of a film with the same number of samples in both halves.
ClassEnergy energy_of(const film::Film& film);

// The root mean square over pixels and channels of the sum of these, all of the same size, with their noise taken off:
// the product of two halves has the square of the mean as its expectation. It is the error of a picture that lacks
// them; a picture of larger pixels has a smaller one.
double rms_of(std::span<const ClassEnergy> energies);

// The same for the square over that of the picture of all energy plus 0.01, as relMSE has it; a mean, not its root.
double relative_square_of(std::span<const ClassEnergy> energies, const ClassEnergy& all);

}  // namespace etendue::advisor
