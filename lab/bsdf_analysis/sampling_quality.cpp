#include "bsdf_analysis/sampling_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/warp.h"
#include "bsdf_analysis/replicates.h"

namespace etendue::bsdf_analysis {
namespace {

constexpr double kAngles[] = {0, 15, 30, 45, 60, 70, 75, 80, 85, 88};

// Where drawing by the cosine does nearly as well: peaks, of which it finds too little to say how much, are left out.
bool is_common(float pdf, const Vec3& wi) { return pdf < 4 * cosine_hemisphere_pdf(std::abs(wi.z)); }

// Of weights; `common` is the mean of those in directions that are found either way.
struct Tally {
  double sum = 0, squares = 0, largest = 0;
  size_t count = 0, lost = 0;
  bool deltas = false;
  Replicates common;

  void add(double weight) {
    sum += weight, squares += weight * weight, largest = std::max(largest, weight);
    ++count;
  }
  double mean() const { return sum / static_cast<double>(count); }
  double deviation() const {
    const double m = mean();
    return m > 0 ? std::sqrt(std::max(0.0, squares / static_cast<double>(count) / (m * m) - 1)) : 0;
  }
};

Tally by_lobes(const Lobes& lobes, const Vec3& wo, uint32_t samples) {
  Tally t;
  for (uint32_t r = 0; r < kReplicates; ++r) {
    double common = 0;
    for (uint32_t i = 0; i < samples / kReplicates; ++i) {
      LobeSample<Rgb> s;
      if (!lobes.sample(wo, draw_of(r, i), TransportMode::radiance, s)) {
        ++t.lost;
        t.add(0);
        continue;
      }
      const double weight = static_cast<double>(average(s.weight));
      t.add(weight);
      t.deltas |= s.delta;
      if (!s.delta && is_common(s.pdf_solid_angle, s.wi)) common += weight;
    }
    t.common.add(common / (samples / kReplicates));
  }
  return t;
}

// Directions by the cosine on either side, half of them each where light passes through.
Tally by_cosine(const Lobes& lobes, const Vec3& wo, bool passes, uint32_t samples) {
  Tally t;
  const double share = passes ? 0.5 : 1;
  for (uint32_t r = 0; r < kReplicates; ++r) {
    double common = 0;
    for (uint32_t i = 0; i < samples / kReplicates; ++i) {
      const LobeRandom draw = draw_of(100 + r, i);
      Vec3 wi = draw.cosine_direction;
      if ((wo.z < 0) != (passes && draw.choice < 0.5f)) wi.z = -wi.z;
      const double weight =
          static_cast<double>(average(lobes.eval(wo, wi, TransportMode::radiance))) * 3.14159265358979323846 / share;
      t.add(weight);
      if (is_common(lobes.pdf(wo, wi, TransportMode::radiance), wi)) common += weight;
    }
    t.common.add(common / (samples / kReplicates));
  }
  return t;
}

}  // namespace

SamplingQuality sampling_quality_at(const Lobes& lobes, double degrees, const SamplingOptions& options) {
  const Vec3 wo = direction(degrees, options.azimuth);
  const Tally own = by_lobes(lobes, wo, options.samples);
  const Tally other = by_cosine(lobes, wo, passes_light(lobes), options.samples);
  SamplingQuality q;
  q.degrees = degrees;
  q.deviation = own.deviation();
  q.largest = own.mean() > 0 ? own.largest / own.mean() : 0;
  q.absorbed = static_cast<double>(own.lost) / static_cast<double>(own.count);
  q.by_cosine = own.deltas ? std::numeric_limits<double>::infinity() : other.deviation();
  // Where neither has any noise, rounding is what is left.
  const double rounding = 1e-4 * std::max(own.mean(), other.mean());
  const double error = std::hypot(own.common.standard_error(), other.common.standard_error(), rounding);
  if (error > 0) q.discrepancy = (own.common.mean() - other.common.mean()) / error;
  return q;
}

std::vector<SamplingQuality> sampling_curve(const Lobes& lobes, const SamplingOptions& options, const Wanted& wanted) {
  std::vector<SamplingQuality> curve;
  for (const double degrees : kAngles) {
    if (!goes_on(wanted)) break;
    curve.push_back(sampling_quality_at(lobes, degrees, options));
  }
  return curve;
}

bool well_sampled(const std::vector<SamplingQuality>& curve) {
  return std::all_of(curve.begin(), curve.end(), [](const SamplingQuality& q) {
    return q.degrees > 80 || (q.deviation <= kWellSampled && std::abs(q.discrepancy) <= kDiscrepancy);
  });
}

}  // namespace etendue::bsdf_analysis
