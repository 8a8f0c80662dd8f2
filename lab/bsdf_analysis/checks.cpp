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

Check check_non_negative(const Plausibility& p) {
  Check check{.name = "non-negative",
              .passed_label = "Non-negative",
              .failed_label = "Negative or not finite",
              .holds = p.non_negative(),
              .reason = {}};
  if (p.not_finite > 0)
    check.reason = text("not finite for %zu of %zu pairs of directions", p.not_finite, p.pairs);
  else if (p.minimum < 0)
    check.reason =
        text("%.3g from %.1f\u00b0 to %.1f\u00b0", p.minimum, degrees_of(p.minimum_wi), degrees_of(p.minimum_wo));
  else
    check.reason = text("no negative value in %zu pairs of directions", p.pairs);
  return check;
}

Check check_reciprocal(const Plausibility& p) {
  Check check{.name = "reciprocal",
              .passed_label = "Reciprocal",
              .failed_label = "Not reciprocal",
              .holds = p.reciprocal(),
              .reason = {}};
  if (p.reciprocal())
    check.reason = text("symmetric within %.1g in %zu pairs of directions", p.asymmetry, p.pairs);
  else
    check.reason = text("%.4g from %.1f\u00b0 to %.1f\u00b0, but %.4g in reverse", p.worst.forward,
                        degrees_of(p.worst.wi), degrees_of(p.worst.wo), p.worst.reverse);
  return check;
}

Check check_energy(const Plausibility& p) {
  const double albedo = static_cast<double>(max_component(p.largest_albedo.value));
  Check check{.name = "conserves-energy",
              .passed_label = "Conserves energy",
              .failed_label = "Not energy conserving",
              .holds = p.conserves_energy(),
              .reason = {}};
  check.reason = text("largest albedo %.4f, at %.4g\u00b0", albedo, p.largest_albedo.degrees);
  return check;
}

Check check_sampling(const std::vector<SamplingQuality>& curve) {
  Check check{.name = "well-sampled",
              .passed_label = "Well sampled",
              .failed_label = "High sampling variance",
              .holds = is_well_sampled(curve),
              .reason = {}};
  const SamplingQuality* worst = nullptr;
  for (const SamplingQuality& q : curve) {
    if (q.degrees > 80) continue;
    if (std::abs(q.discrepancy) > kMaxDiscrepancy) {
      check.failed_label = "Samples disagree with values";
      check.reason =
          text("samples and values differ by %.0f standard errors at %.4g\u00b0", std::abs(q.discrepancy), q.degrees);
      return check;
    }
    if (!worst || q.deviation > worst->deviation) worst = &q;
  }
  if (worst)
    check.reason = text("relative deviation of the weights %.2g at %.4g\u00b0 (cosine sampling: %.2g)",
                        worst->deviation, worst->degrees, worst->cosine_deviation);
  return check;
}

}  // namespace

SurfaceAnalysis analyze(const Lobes& lobes, const KeepGoing& keep_going) {
  SurfaceAnalysis a;
  a.albedo = albedo_curve(lobes, false, {}, keep_going);
  if (transmits_light(lobes)) a.albedo_inside = albedo_curve(lobes, true, {}, keep_going);
  std::vector<Albedo> both = a.albedo;
  both.insert(both.end(), a.albedo_inside.begin(), a.albedo_inside.end());
  a.plausibility = plausibility(lobes, both, keep_going);
  a.sampling = sampling_curve(lobes, {}, keep_going);
  a.checks = {check_non_negative(a.plausibility), check_reciprocal(a.plausibility), check_energy(a.plausibility),
              check_sampling(a.sampling)};
  return a;
}

}  // namespace etendue::bsdf_analysis
