#include "bsdf_analysis/plausibility.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"

namespace etendue::bsdf_analysis {
namespace {

constexpr uint32_t kPairs = 2000;

// Where f lives: half of the second directions are samples of the lobes, the others are from anywhere.
Vec3 partner(const Lobes& lobes, const Vec3& wo, uint32_t i) {
  LobeSample<Rgb> s;
  if (i % 2 == 0 && lobes.sample(wo, draw_of(1, i), TransportMode::radiance, s) && !s.delta) return s.wi;
  const LobeRandom draw = draw_of(2, i);
  return square_to_sphere(draw.u);
}

void look_at(const Lobes& lobes, const Vec3& wo, const Vec3& wi, float eta, Plausibility& p) {
  const Rgb forth = lobes.eval(wo, wi, TransportMode::radiance), back = lobes.eval(wi, wo, TransportMode::radiance);
  ++p.pairs;
  if (!is_finite(forth) || !is_finite(back)) {
    ++p.not_finite;
    return;
  }
  for (int c = 0; c < 3; ++c)
    if (static_cast<double>(forth[c]) < p.least)
      p.least = static_cast<double>(forth[c]), p.least_wo = wo, p.least_wi = wi;
  // f(wi -> wo) / eta_o^2 = f(wo -> wi) / eta_i^2                                              thesis (4.299), item 68
  double law = 1;
  if (wo.z * wi.z < 0) law = wo.z > 0 ? static_cast<double>(sqr(eta)) : 1 / static_cast<double>(sqr(eta));
  for (int c = 0; c < 3; ++c) {
    const double a = static_cast<double>(forth[c]) * law, b = static_cast<double>(back[c]);
    const double larger = std::max(std::abs(a), std::abs(b));
    // What is smaller than any light that could be told from none is not looked at.
    if (larger < 1e-7) continue;
    if (const double difference = std::abs(a - b) / larger; difference > p.asymmetry)
      p.asymmetry = difference, p.worst = {wo, wi, a, b};
  }
}

}  // namespace

Plausibility plausibility(const Lobes& lobes, const std::vector<Albedo>& curve, const Wanted& wanted) {
  Plausibility p;
  const float eta = relative_eta(lobes);
  for (uint32_t i = 0; i < kPairs && (i % 64 != 0 || goes_on(wanted)); ++i) {
    const LobeRandom draw = draw_of(3, i);
    // Up to 89.9 degrees from the normal, on either side.
    Vec3 wo = direction(89.9 * static_cast<double>(draw.u.x), 360 * static_cast<double>(draw.u.y));
    if (draw.choice < 0.5f) wo.z = -wo.z;
    look_at(lobes, wo, partner(lobes, wo, i), eta, p);
  }
  size_t over = 0;
  for (const Albedo& a : curve) {
    if (max_component(a.value) > max_component(p.most.value)) p.most = a;
    over += static_cast<double>(max_component(a.value)) > 1 + Plausibility::kExcess + 3 * a.error;
  }
  p.share_over_one = curve.empty() ? 0 : static_cast<double>(over) / static_cast<double>(curve.size());
  return p;
}

}  // namespace etendue::bsdf_analysis
