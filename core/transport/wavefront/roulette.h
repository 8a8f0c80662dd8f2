// Russian roulette: a path survives with a probability, by which its throughput is divided.  [Lang, eq. 9.10, Remark 9.3]
#pragma once
#include <algorithm>
#include <array>

#include "base/parameter.h"
#include "bsdf/lobe.h"
#include "transport/wavefront/path_state.h"

namespace etendue::transport {

// Bounds of the survival probability: below one, so that paths end in scenes without absorption. With a throughput
// factor r and a survival probability q per vertex, the variance is finite only if r^2 < q. Paths whose throughput has
// grown above one therefore survive with a higher probability.
inline constexpr float kMaxSurvival = 0.95f, kMaxSurvivalAboveOne = 0.995f;
// In scattering media with an end: a path through milk has hundreds of vertices at which it loses 0.2 %. With the
// bounds above, r^2 > q, and the few longest paths would carry most of the light.
inline constexpr float kMaxSurvivalInMedia = 0.9995f;

// The probability is the largest component of the throughput of the path, a constant, or that of the factor f cos / p
// of the last scattering, which is the albedo of a diffuse surface [Lang, Remark 9.3].
enum class SurvivalRule : uint8_t { throughput, constant, albedo };

struct RouletteSettings {
  int start;  // the path length from which paths are terminated
  SurvivalRule rule = SurvivalRule::throughput;
  float constant = 0.8f;  // the survival probability of the constant rule
  float minimum = 0;      // of the other rules' probabilities

  // By the throughput.
  constexpr RouletteSettings(int from) : start(from) {}       // NOLINT: a start depth alone
  RouletteSettings(const Number<int>& from) : start(from) {}  // NOLINT
};

// `weight`: the quantity that determines the probability.
inline float bounded_survival(float weight, bool in_medium) {
  if (in_medium) return std::min(weight, kMaxSurvivalInMedia);
  return std::min(weight, weight > 1 ? kMaxSurvivalAboveOne : kMaxSurvival);
}
// By the throughput, corrected for the change of radiance by refraction.
template <class Color>
float survival_probability(const PathState<Color>& path, bool in_medium) {
  return bounded_survival(max_component(path.throughput) * path.eta_scale, in_medium);
}
template <class Color>
[[gnu::cold, gnu::noinline]] float survival_by_rule(const RouletteSettings& roulette, const LobeSample<Color>& s,
                                                    bool in_medium) {
  if (roulette.rule == SurvivalRule::constant) return roulette.constant;
  return std::max(bounded_survival(max_component(s.weight) * s.eta * s.eta, in_medium), roulette.minimum);
}
// After the path has been scattered by `s`, which its throughput contains.
template <class Color>
float survival_probability(const RouletteSettings& roulette, const PathState<Color>& path, const LobeSample<Color>& s,
                           bool in_medium) {
  if (roulette.rule != SurvivalRule::throughput) [[unlikely]]
    return survival_by_rule(roulette, s, in_medium);
  return std::max(survival_probability(path, in_medium), roulette.minimum);
}

}  // namespace etendue::transport

template <>
struct etendue::Options<etendue::transport::SurvivalRule> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"throughput", "Throughput"}, {"constant", "Constant"}, {"albedo", "Albedo"}}};
};
