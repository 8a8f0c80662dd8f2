#include "bsdf_analysis/plausibility.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"

namespace etendue::bsdf_analysis {
namespace {

constexpr uint32_t kPairs = 2000;

// The second direction of a pair. Every other one is a sample of the lobes, where f is large; the rest are uniform.
Vec3 second_direction(const Lobes& lobes, const Vec3& wo, uint32_t i) {
  LobeSample<Rgb> s;
  if (i % 2 == 0 && lobes.sample(wo, draw_of(1, i), TransportMode::radiance, s) && !s.delta) return s.wi;
  const LobeRandom draw = draw_of(2, i);
  return square_to_sphere(draw.u);
}

void test_pair(const Lobes& lobes, const Vec3& wo, const Vec3& wi, float eta, Plausibility& p) {
  const Rgb forward = lobes.eval(wo, wi, TransportMode::radiance);
  const Rgb reverse = lobes.eval(wi, wo, TransportMode::radiance);
  ++p.pairs;
  if (!is_finite(forward) || !is_finite(reverse)) {
    ++p.not_finite;
    return;
  }
  for (int c = 0; c < 3; ++c)
    if (static_cast<double>(forward[c]) < p.minimum) {
      p.minimum = static_cast<double>(forward[c]);
      p.minimum_wo = wo;
      p.minimum_wi = wi;
    }
  // f(wi -> wo) / eta_o^2 = f(wo -> wi) / eta_i^2; plain symmetry holds for reflection only.   [Lang, sec. 4.2.3]
  double scale = 1;
  if (wo.z * wi.z < 0) scale = wo.z > 0 ? static_cast<double>(sqr(eta)) : 1 / static_cast<double>(sqr(eta));
  for (int c = 0; c < 3; ++c) {
    const double a = static_cast<double>(forward[c]) * scale, b = static_cast<double>(reverse[c]);
    const double larger = std::max(std::abs(a), std::abs(b));
    constexpr double kNegligible = 1e-7;  // relative differences of smaller values are rounding errors
    if (larger < kNegligible) continue;
    if (const double difference = std::abs(a - b) / larger; difference > p.asymmetry) {
      p.asymmetry = difference;
      p.worst = {.wo = wo, .wi = wi, .forward = a, .reverse = b};
    }
  }
}

}  // namespace

Plausibility plausibility(const Lobes& lobes, const std::vector<Albedo>& curve, const KeepGoing& keep_going) {
  Plausibility p;
  const float eta = relative_eta(lobes);
  for (uint32_t i = 0; i < kPairs && (i % 64 != 0 || should_continue(keep_going)); ++i) {
    const LobeRandom draw = draw_of(3, i);
    // Up to 89.9 degrees from the normal, on either side.
    Vec3 wo = direction(89.9 * static_cast<double>(draw.u.x), 360 * static_cast<double>(draw.u.y));
    if (draw.choice < 0.5f) wo.z = -wo.z;
    test_pair(lobes, wo, second_direction(lobes, wo, i), eta, p);
  }
  size_t over = 0;
  for (const Albedo& a : curve) {
    if (max_component(a.value) > max_component(p.largest_albedo.value)) p.largest_albedo = a;
    over += static_cast<double>(max_component(a.value)) > 1 + Plausibility::kExcess + 3 * a.error;
  }
  p.share_over_one = curve.empty() ? 0 : static_cast<double>(over) / static_cast<double>(curve.size());
  return p;
}

}  // namespace etendue::bsdf_analysis
