#include "bsdf_analysis/checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace etendue::bsdf_analysis {
namespace {

template <class... Args>
std::string text(const char* format, Args... args) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, args...);
  return buffer;
}

double degrees_of(const Vec3& w) {
  return std::acos(std::clamp(static_cast<double>(w.z), -1.0, 1.0)) * 180 / 3.14159265358979323846;
}

Check non_negative(const Plausibility& p) {
  Check b{"non-negative", "Nowhere negative", "Negative or no number", p.non_negative(), {}};
  if (p.not_finite > 0)
    b.reason = text("no number for %zu of %zu pairs of directions", p.not_finite, p.pairs);
  else if (p.least < 0)
    b.reason = text("%.3g from %.1f\u00b0 to %.1f\u00b0", p.least, degrees_of(p.least_wi), degrees_of(p.least_wo));
  else
    b.reason = text("nowhere below zero in %zu pairs of directions", p.pairs);
  return b;
}

Check reciprocal(const Plausibility& p) {
  Check b{"reciprocal", "Reciprocal", "Not reciprocal", p.reciprocal(), {}};
  if (p.reciprocal())
    b.reason = text("both ways alike to %.1g in %zu pairs of directions", p.asymmetry, p.pairs);
  else
    b.reason = text("%.4g from %.1f\u00b0 to %.1f\u00b0, but %.4g back", p.worst.forth, degrees_of(p.worst.wi),
                    degrees_of(p.worst.wo), p.worst.back);
  return b;
}

Check conserves_energy(const Plausibility& p) {
  const double most = static_cast<double>(max_component(p.most.value));
  Check b{"conserves-energy", "Conserves energy", "Makes light", p.conserves_energy(), {}};
  b.reason = b.holds ? text("at most %.4f of the light leaves, at %.4g\u00b0", most, p.most.degrees)
                     : text("%.4g times the light that comes leaves again, at %.4g\u00b0", most, p.most.degrees);
  return b;
}

Check sampled(const std::vector<SamplingQuality>& curve) {
  Check b{"well-sampled", "Well sampled", "Badly sampled", well_sampled(curve), {}};
  const SamplingQuality* worst = nullptr;
  for (const SamplingQuality& q : curve) {
    if (q.degrees > 80) continue;
    if (std::abs(q.discrepancy) > kDiscrepancy) {
      b.reason =
          text("samples and values disagree by %.0f standard errors at %.4g\u00b0", std::abs(q.discrepancy), q.degrees);
      return b;
    }
    if (!worst || q.deviation > worst->deviation) worst = &q;
  }
  if (worst)
    b.reason = text("weights deviate by %.2g of their mean at %.4g\u00b0 (%.2g if drawn by the cosine)",
                    worst->deviation, worst->degrees, worst->by_cosine);
  return b;
}

}  // namespace

Audit audit(const Lobes& lobes, const Wanted& wanted) {
  Audit a;
  a.albedo = albedo_curve(lobes, false, {}, wanted);
  if (passes_light(lobes)) a.albedo_inside = albedo_curve(lobes, true, {}, wanted);
  std::vector<Albedo> both = a.albedo;
  both.insert(both.end(), a.albedo_inside.begin(), a.albedo_inside.end());
  a.plausibility = plausibility(lobes, both, wanted);
  a.sampling = sampling_curve(lobes, {}, wanted);
  a.badges = {non_negative(a.plausibility), reciprocal(a.plausibility), conserves_energy(a.plausibility),
              sampled(a.sampling)};
  return a;
}

}  // namespace etendue::bsdf_analysis
