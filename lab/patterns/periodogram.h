// Fourier spectra of point sets: regular structure shows as peaks, clumps as power at low frequencies.
//                                                                                     [Lang, eq. 7.58; Ulichney 1988]
#pragma once
#include "patterns/point_set.h"

namespace etendue::patterns {

// P(k) = |sum of exp(-2 pi i k.x)|^2 / N at the whole frequencies from -extent to extent along each axis. P(0) is N; the
// mean of random points is 1 elsewhere.
struct Periodogram {
  int extent = 0;
  std::vector<double> power;  // rows of 2 extent + 1 values, from -extent

  double at(int kx, int ky) const {
    const int side = 2 * extent + 1;
    return power[static_cast<size_t>((ky + extent) * side + kx + extent)];
  }
  double& at(int kx, int ky) {
    const int side = 2 * extent + 1;
    return power[static_cast<size_t>((ky + extent) * side + kx + extent)];
  }
};

// Of one set, and the mean over several sets, at least one. Time O(N extent^2) for each. The sums are exact at the places
// of the points; a fast Fourier transform would first round them to a grid.
Periodogram periodogram(const PointSet& points, int extent);
Periodogram mean_periodogram(const std::vector<PointSet>& sets, int extent);

// Mean and anisotropy over the frequencies with k - 1/2 <= |k| < k + 1/2, for k = 1, ..., extent.
struct RadialSpectrum {
  std::vector<double> mean;
  // The variance of P on the ring relative to the square of its mean. 1 for random points.
  std::vector<double> anisotropy;
};
RadialSpectrum radial_spectrum(const Periodogram& spectrum);

}  // namespace etendue::patterns
