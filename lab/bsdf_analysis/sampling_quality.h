// How closely the sampling density of a surface follows f cos.
//
// If the density were f cos / albedo, every sample weight f cos / pdf would equal the albedo. The relative standard
// deviation of the weights is the noise that one scattering event adds to the throughput of a path.
#pragma once
#include <functional>
#include <vector>

#include "bsdf_analysis/test_surface.h"

namespace etendue::bsdf_analysis {

struct SamplingQuality {
  double degrees = 0;           // polar angle of wo
  double deviation = 0;         // standard deviation of the weights divided by their mean; includes delta lobes
  double largest = 0;           // the largest weight divided by the mean
  double absorbed = 0;          // the fraction of samples without a direction
  double cosine_deviation = 0;  // the deviation with cosine-weighted directions; infinite if there are delta lobes
  // Difference between the integrals of f cos found by both samplings, in standard errors. Only directions count in
  // which the density of the lobes is at most four times the cosine density. Large values mean that the samples do not
  // follow the density or miss directions in which f is not zero.
  double discrepancy = 0;
};

struct SamplingOptions {
  double azimuth = 20;  // degrees
  uint32_t samples = 8192;
};

// A surface as sampling sees it: f, the density per solid angle that is claimed for samples, and samples with their
// weights f cos / pdf. All for radiance.
struct SampledSurface {
  std::function<Rgb(const Vec3& wo, const Vec3& wi)> eval;
  std::function<float(const Vec3& wo, const Vec3& wi)> pdf;
  std::function<bool(const Vec3& wo, const LobeRandom& random, LobeSample<Rgb>& s)> sample;
  bool transmits = false;  // samples cross the surface
};
// Refers to the lobes, which must outlive it.
SampledSurface sampled_surface(const Lobes& lobes);

SamplingQuality sampling_quality_at(const SampledSurface& surface, double degrees, const SamplingOptions& options = {});
inline SamplingQuality sampling_quality_at(const Lobes& lobes, double degrees, const SamplingOptions& options = {}) {
  return sampling_quality_at(sampled_surface(lobes), degrees, options);
}
std::vector<SamplingQuality> sampling_curve(const Lobes& lobes, const SamplingOptions& options = {},
                                            const KeepGoing& keep_going = {});

// True if deviation and discrepancy stay within these limits at every angle up to 80 degrees.
inline constexpr double kMaxDeviation = 1.0, kMaxDiscrepancy = 5;
bool is_well_sampled(const std::vector<SamplingQuality>& curve);

}  // namespace etendue::bsdf_analysis
