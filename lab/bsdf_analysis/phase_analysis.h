// Measurements of a phase function: normalisation, mean cosine and the agreement of samples with the density.
#pragma once
#include <cstdint>

#include "bsdf_analysis/checks.h"
#include "bsdf_analysis/lobe_shape.h"
#include "medium/phase_function.h"

namespace etendue::bsdf_analysis {

struct PhaseAnalysis {
  double integral = 0;              // of p over all directions, by quadrature; 1 if p is normalised
  double mean_cosine = 0;           // by quadrature
  double stated_mean_cosine = 0;    // of the phase function
  double backward = 0;              // fraction scattered by more than 90 degrees
  double minimum = 0, maximum = 0;  // of p on the quadrature points, 1/sr
  // The largest difference between the distribution functions of samples and of p, times the root of the number of
  // samples. Above 1.95 with a probability of 1e-3 if the samples follow p (Kolmogorov-Smirnov).
  double sampling_deviation = 0;
  uint32_t samples = 0;
  std::vector<Check> checks;

  static constexpr double kTolerance = 1e-5;  // of the integral and of the mean cosine
  static constexpr double kMaxSamplingDeviation = 1.95;
};

PhaseAnalysis analyze(const PhaseFunction& phase, uint32_t samples = 100'000);

// p in a plane that contains the direction of propagation, which is at 0 degrees; 1/sr.
Slice phase_slice(const PhaseFunction& phase, int steps = 1441);

}  // namespace etendue::bsdf_analysis
