// How well a surface's sampling follows what it reflects.
//
// The weights f cos / pdf of samples would all be the albedo if the density were f cos / albedo. Their deviation, in
// parts of the mean, is what a path's throughput gains in noise at such a surface.
#pragma once
#include <vector>

#include "bsdf_analysis/test_surface.h"

namespace etendue::bsdf_analysis {

struct SamplingQuality {
  double degrees = 0;
  double deviation = 0;  // standard deviation of the weights over their mean; deltas take part
  double largest = 0;    // the largest weight over the mean
  double absorbed = 0;   // the share of samples that lead nowhere
  double by_cosine = 0;  // the deviation if directions were drawn by the cosine; infinite where there are deltas
  // Between what both find where the lobes' density is not much above the cosine's, in standard errors: far from 0 if
  // samples do not follow their density there, or miss what f has.
  double discrepancy = 0;
};

struct SamplingOptions {
  double azimuth = 20;
  uint32_t samples = 8192;
};

SamplingQuality sampling_quality_at(const Lobes& lobes, double degrees, const SamplingOptions& options = {});
std::vector<SamplingQuality> sampling_curve(const Lobes& lobes, const SamplingOptions& options = {},
                                            const Wanted& wanted = {});

// The limits of what is called well sampled, at every angle up to 80 degrees.
inline constexpr double kWellSampled = 1.0, kDiscrepancy = 5;
bool well_sampled(const std::vector<SamplingQuality>& curve);

}  // namespace etendue::bsdf_analysis
