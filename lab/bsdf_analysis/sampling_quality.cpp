#include "bsdf_analysis/sampling_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/warp.h"
#include "bsdf_analysis/replicates.h"

namespace etendue::bsdf_analysis {
namespace {

constexpr double kTestedAngles[] = {0, 15, 30, 45, 60, 70, 75, 80, 85, 88};

// True for directions that both samplings find often enough for a comparison; narrow peaks are left out.
bool is_common(float pdf, const Vec3& wi) { return pdf < 4 * cosine_hemisphere_pdf(std::abs(wi.z)); }

// Statistics of the weights of one sampling; `common` is the mean over directions for which is_common holds.
struct WeightStatistics {
  double sum = 0, squares = 0, largest = 0;
  size_t count = 0, absorbed = 0;
  bool has_deltas = false;
  Replicates common;

  void add(double weight) {
    sum += weight;
    squares += weight * weight;
    largest = std::max(largest, weight);
    ++count;
  }
  double mean() const { return sum / static_cast<double>(count); }
  double deviation() const {
    const double m = mean();
    return m > 0 ? std::sqrt(std::max(0.0, squares / static_cast<double>(count) / (m * m) - 1)) : 0;
  }
};

WeightStatistics sample_lobes(const SampledSurface& surface, const Vec3& wo, uint32_t samples) {
  WeightStatistics t;
  for (uint32_t r = 0; r < kReplicates; ++r) {
    double common = 0;
    for (uint32_t i = 0; i < samples / kReplicates; ++i) {
      LobeSample<Rgb> s;
      if (!surface.sample(wo, draw_of(r, i), s)) {
        ++t.absorbed;
        t.add(0);
        continue;
      }
      const double weight = static_cast<double>(average(s.weight));
      t.add(weight);
      t.has_deltas |= s.delta;
      if (!s.delta && is_common(s.pdf_solid_angle, s.wi)) common += weight;
    }
    t.common.add(common / (samples / kReplicates));
  }
  return t;
}

// Cosine-weighted directions; on transmissive surfaces half of them on either side.
WeightStatistics sample_cosine(const SampledSurface& surface, const Vec3& wo, uint32_t samples) {
  WeightStatistics t;
  const double share = surface.transmits ? 0.5 : 1;
  for (uint32_t r = 0; r < kReplicates; ++r) {
    double common = 0;
    for (uint32_t i = 0; i < samples / kReplicates; ++i) {
      const LobeRandom draw = draw_of(100 + r, i);
      Vec3 wi = draw.cosine_direction;
      if ((wo.z < 0) != (surface.transmits && draw.choice < 0.5f)) wi.z = -wi.z;
      const double weight = static_cast<double>(average(surface.eval(wo, wi))) * 3.14159265358979323846 / share;
      t.add(weight);
      if (is_common(surface.pdf(wo, wi), wi)) common += weight;
    }
    t.common.add(common / (samples / kReplicates));
  }
  return t;
}

}  // namespace

SampledSurface sampled_surface(const Lobes& lobes) {
  return {.eval = [&lobes](const Vec3& wo, const Vec3& wi) { return lobes.eval(wo, wi, TransportMode::radiance); },
          .pdf = [&lobes](const Vec3& wo, const Vec3& wi) { return lobes.pdf(wo, wi, TransportMode::radiance); },
          .sample = [&lobes](const Vec3& wo, const LobeRandom& random,
                             LobeSample<Rgb>& s) { return lobes.sample(wo, random, TransportMode::radiance, s); },
          .transmits = transmits_light(lobes)};
}

SamplingQuality sampling_quality_at(const SampledSurface& surface, double degrees, const SamplingOptions& options) {
  const Vec3 wo = direction(degrees, options.azimuth);
  const WeightStatistics by_lobes = sample_lobes(surface, wo, options.samples);
  const WeightStatistics by_cosine = sample_cosine(surface, wo, options.samples);
  SamplingQuality q;
  q.degrees = degrees;
  q.deviation = by_lobes.deviation();
  q.largest = by_lobes.mean() > 0 ? by_lobes.largest / by_lobes.mean() : 0;
  q.absorbed = static_cast<double>(by_lobes.absorbed) / static_cast<double>(by_lobes.count);
  q.cosine_deviation = by_lobes.has_deltas ? std::numeric_limits<double>::infinity() : by_cosine.deviation();
  // If neither estimate has noise, only rounding errors remain.
  const double rounding = 1e-4 * std::max(by_lobes.mean(), by_cosine.mean());
  const double error = std::hypot(by_lobes.common.standard_error(), by_cosine.common.standard_error(), rounding);
  if (error > 0) q.discrepancy = (by_lobes.common.mean() - by_cosine.common.mean()) / error;
  return q;
}

std::vector<SamplingQuality> sampling_curve(const Lobes& lobes, const SamplingOptions& options,
                                            const KeepGoing& keep_going) {
  std::vector<SamplingQuality> curve;
  for (const double degrees : kTestedAngles) {
    if (!should_continue(keep_going)) break;
    curve.push_back(sampling_quality_at(lobes, degrees, options));
  }
  return curve;
}

bool is_well_sampled(const std::vector<SamplingQuality>& curve) {
  return std::all_of(curve.begin(), curve.end(), [](const SamplingQuality& q) {
    return q.degrees > 80 || (q.deviation <= kMaxDeviation && std::abs(q.discrepancy) <= kMaxDiscrepancy);
  });
}

}  // namespace etendue::bsdf_analysis
