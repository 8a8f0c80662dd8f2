// Markov chains: how fast they approach their stationary distribution [Lang, eq. 2.881-2.903, 6.344-6.348]
//
// The distribution after n steps is p_n = p_0 P^n, a power iteration. Its distance to the stationary distribution falls
// as |lambda|^n, where lambda is the second largest eigenvalue. A simulation counts the states that one path visits; the
// error of these frequencies falls as n^(-1/2), for any lambda with modulus below 1 (ergodic theorem).
//
//   die      independent throws: one step suffices
//   coin     two states with probabilities 0.6 and 0.4, whatever the state is [Lang, eq. 6.346, corrected]
//   photon   light between four diffuse surfaces: 1/3 for each of the others; lambda = -1/3
//   mirror   the same surfaces, one of them a mirror: the state is the pair of the last two surfaces, because a mirror
//            remembers the direction; twelve states with the probability 1/12, lambda = 0.7676 [Lang, eq. 2.898]
//   grammar  a path from the light: L, D and S are followed by D, S or E with probability 1/3 each; E is the eye, and the
//            end [Lang, eq. 2.902, corrected]. The mean number of segments is 3.
//   ring     Metropolis sampling of (1, 2, 3, 4)/10 on a ring of four states
//   swap     two states that alternate: periodic, so that p_n does not converge although the frequencies do
//   stay     two states that never change: the stationary distribution is not unique, an error
#include <algorithm>
#include <array>
#include <cmath>

#include "equations/markov_chain.h"
#include "experiments/error_curves.h"
#include "experiments/moments.h"

namespace etendue::experiments {

enum class ChainKind { die, coin, photon, mirror, grammar, ring, swap, stay };

}  // namespace etendue::experiments

template <>
struct etendue::Options<etendue::experiments::ChainKind> {
  static constexpr std::array<etendue::Option, 8> kOptions{{{"die", "Die"},
                                                            {"coin", "Biased coin"},
                                                            {"photon", "Light between four diffuse surfaces"},
                                                            {"mirror", "Light between four surfaces, one a mirror"},
                                                            {"grammar", "Path expression L(D|S)*E"},
                                                            {"ring", "Metropolis on a ring"},
                                                            {"swap", "Alternating states"},
                                                            {"stay", "States that never change"}}};
};

namespace etendue::experiments {
namespace {

using equations::Distribution;
using equations::MarkovChain;

std::vector<std::string> numbered(const char* prefix, int count) {
  std::vector<std::string> names;
  for (int i = 1; i <= count; ++i) names.push_back(prefix + std::to_string(i));
  return names;
}

// The states are ordered pairs of different surfaces: 12, 13, 14, 21 ... Surface 2 is a mirror, which sends light from
// surface 1 to 3, from 3 to 1 and from 4 to 4.
MarkovChain mirror_chain() {
  MarkovChain chain;
  std::vector<std::array<int, 2>> pairs;
  for (int from = 1; from <= 4; ++from)
    for (int to = 1; to <= 4; ++to)
      if (from != to) pairs.push_back({from, to});
  constexpr std::array<int, 5> kReflected{0, 3, 0, 1, 4};
  for (const auto& [from, to] : pairs) {
    chain.states.push_back(std::to_string(from) + std::to_string(to));
    std::vector<double> row;
    for (const auto& next : pairs) {
      if (next[0] != to)
        row.push_back(0);
      else if (to == 2)
        row.push_back(next[1] == kReflected[static_cast<size_t>(from)] ? 1 : 0);
      else
        row.push_back(1.0 / 3);
    }
    chain.transitions.push_back(row);
  }
  return chain;
}

MarkovChain make_chain(ChainKind kind) {
  constexpr double t = 1.0 / 3;
  switch (kind) {
    case ChainKind::die:
      return {numbered("", 6), std::vector(6, std::vector(6, 1.0 / 6))};
    case ChainKind::coin:
      return {{"heads", "tails"}, {{0.6, 0.4}, {0.6, 0.4}}};
    case ChainKind::photon:
      return {numbered("surface ", 4), {{0, t, t, t}, {t, 0, t, t}, {t, t, 0, t}, {t, t, t, 0}}};
    case ChainKind::mirror:
      return mirror_chain();
    case ChainKind::grammar:
      return {{"L", "D", "S", "E"}, {{0, t, t, t}, {0, t, t, t}, {0, t, t, t}, {0, 0, 0, 1}}};
    case ChainKind::ring:
      return {numbered("state ", 4),
              {{0, 0.5, 0, 0.5}, {0.25, 0.25, 0.5, 0}, {0, t, t / 2, 0.5}, {0.125, 0, 0.375, 0.5}}};
    case ChainKind::swap:
      return {{"A", "B"}, {{0, 1}, {1, 0}}};
    case ChainKind::stay:
      break;
  }
  return {{"A", "B"}, {{1, 0}, {0, 1}}};
}

// The stationary distribution in closed form.
Distribution known_distribution(ChainKind kind) {
  switch (kind) {
    case ChainKind::coin:
      return {0.6, 0.4};
    case ChainKind::grammar:
      return {0, 0, 0, 1};
    case ChainKind::ring:
      return {0.1, 0.2, 0.3, 0.4};
    default: {
      const size_t n = make_chain(kind).size();
      return Distribution(n, 1.0 / static_cast<double>(n));
    }
  }
}

struct Markov {
  static constexpr ExperimentDescription kDescription{
      .name = "markov",
      .label = "Markov chains",
      .summary = "The stationary distribution of a chain in closed form, by power iteration and by simulation",
      .source = "[Lang, eq. 2.881-2.903, 6.344-6.354]"};

  Choice<ChainKind> chain{"chain", "Chain", ChainKind::mirror, "States and transition probabilities"};
  Number<int> steps{"steps", "Steps", 40, {1, 1000}, "Number of steps of the power iteration"};
  Number<int> path{"path", "Path length",     16384, {64, 4194304}, "Number of steps of a simulated path",
                   "",     Scale::logarithmic};
  auto parameters() { return std::tie(chain, steps, path); }

  Result<ExperimentResult> run(const RunContext& context) const {
    const MarkovChain c = make_chain(chain);
    const auto stationary = equations::stationary_distribution(c);
    if (!stationary) return stationary.error();
    ExperimentResult result;
    add_power_iteration(c, *stationary, result);
    auto simulated = simulate(c, *stationary, context);
    if (!simulated) return simulated.error();
    add_simulation(*simulated, result);
    const Distribution frequencies = visits(c, context.seed);
    add_table(c, *stationary, frequencies, result);
    if (chain == ChainKind::grammar) add_path_length(c, context.seed, result);
    return result;
  }

 private:
  Distribution start(const MarkovChain& c) const {
    Distribution p(c.size(), 0.0);
    p[0] = 1;
    return p;
  }

  void add_power_iteration(const MarkovChain& c, const Distribution& stationary, ExperimentResult& result) const {
    const double lambda = equations::eigenvalue_moduli(c)[1];
    metrics::FunctionCurve distance{.name = "power iteration", .points = {}};
    metrics::FunctionCurve rate{.name = "|\u03bb|^n", .style = metrics::CurveStyle::dashed, .points = {}};
    Distribution p = start(c);
    for (int n = 0; n <= steps; ++n, p = equations::next_distribution(c, p)) {
      distance.points.push_back({static_cast<double>(n), equations::total_variation(p, stationary)});
      rate.points.push_back({static_cast<double>(n), std::pow(lambda, n)});
    }
    // Rounding errors below this would hide the rate.
    std::erase_if(distance.points, [](const metrics::Point& q) { return q.y < 1e-14; });
    std::erase_if(rate.points, [](const metrics::Point& q) { return q.y < 1e-14; });
    result.charts.emplace_back(metrics::FunctionChart{.title = "Distance to the stationary distribution",
                                                      .x_label = "steps",
                                                      .y_label = "total variation",
                                                      .curves = {distance, rate},
                                                      .logarithmic_y = true});
    result.checks.push_back({"closed form of the stationary distribution",
                             equations::total_variation(stationary, known_distribution(chain)), 0, 1e-12});
    if (lambda > 1 - 1e-9)
      result.notes.push_back(
          "The second eigenvalue has modulus 1: the chain is periodic, and its distribution after n "
          "steps does not converge.");
    else
      add_decay_check(distance.points, lambda, result);
    if (chain == ChainKind::mirror) result.checks.push_back({"|\u03bb|", lambda, 0.767592, 1e-6});
    if (chain == ChainKind::photon) result.checks.push_back({"|\u03bb|", lambda, 1.0 / 3, 1e-12});
  }

  // The factor of the distance per step over the second half of the steps. With complex eigenvalues the distance
  // oscillates by a factor that does not grow.
  static void add_decay_check(const std::vector<metrics::Point>& distances, double lambda, ExperimentResult& result) {
    if (distances.size() < 20) return;
    const metrics::Point &middle = distances[distances.size() / 2], &last = distances.back();
    result.checks.push_back(
        {"factor of the distance per step", std::pow(last.y / middle.y, 1 / (last.x - middle.x)), lambda, 0.03});
  }

  // The root of the sum of squared errors of the frequencies.
  Result<metrics::MethodCurves> simulate(const MarkovChain& c, const Distribution& stationary,
                                         const RunContext& context) const {
    const auto work = powers_of_two(3, static_cast<int>(std::log2(path.value)));
    const auto errors = [&](int repeat, std::span<double> out) {
      equations::RandomNumbers random(mix_bits(context.seed) + static_cast<uint64_t>(repeat) + 1);
      std::vector<double> counts(c.size(), 0.0);
      size_t state = 0, k = 0;
      for (int i = 1; k < work.size(); ++i) {
        state = equations::next_state(c, state, random.uniform());
        ++counts[state];
        if (i != static_cast<int>(work[k])) continue;
        double squares = 0;
        for (size_t s = 0; s < c.size(); ++s) squares += std::pow(counts[s] / i - stationary[s], 2);
        out[k++] = std::sqrt(squares);
      }
    };
    return rms_error_curves("simulation", work, {}, errors, context);
  }

  void add_simulation(const metrics::MethodCurves& curves, ExperimentResult& result) const {
    // The end of a path is absorbing, and an alternating chain has the error 1/n.
    const bool random = chain != ChainKind::grammar && chain != ChainKind::swap;
    const auto s = slope(curves, 64);
    if (random && s.known)
      result.checks.push_back({"slope of the simulation", s.value, -0.5, std::max(0.05, 3 * s.standard_error)});
    result.charts.emplace_back(
        ErrorChart{.title = "Error of simulated frequencies", .work = "steps", .curves = {curves}});
  }

  Distribution visits(const MarkovChain& c, uint64_t seed) const {
    equations::RandomNumbers random(mix_bits(seed));
    Distribution frequencies(c.size(), 0.0);
    size_t state = 0;
    for (int i = 0; i < path; ++i) {
      state = equations::next_state(c, state, random.uniform());
      frequencies[state] += 1.0 / path;
    }
    return frequencies;
  }

  void add_table(const MarkovChain& c, const Distribution& stationary, const Distribution& frequencies,
                 ExperimentResult& result) const {
    Distribution p = start(c);
    for (int n = 0; n < steps; ++n) p = equations::next_distribution(c, p);
    result.table.columns = {"state", "stationary", "power iteration", "simulation"};
    for (size_t s = 0; s < c.size(); ++s)
      result.table.rows.push_back({c.states[s], stationary[s], p[s], frequencies[s]});
  }

  // Paths of L(D|S)*E: a path of n segments has the probability 2^(n-1) / 3^n, 3 in the mean, and 8/81 for four segments.
  void add_path_length(const MarkovChain& c, uint64_t seed, ExperimentResult& result) const {
    constexpr size_t kEnd = 3;
    equations::RandomNumbers random(mix_bits(seed) + 17);
    Moments lengths, fours;
    for (int i = 0; i < path; ++i) {
      int length = 0;
      for (size_t state = 0; state != kEnd; ++length) state = equations::next_state(c, state, random.uniform());
      lengths.add(length);
      fours.add(length == 4 ? 1 : 0);
    }
    result.checks.push_back({"mean path length", lengths.mean(), 3, kStandardErrors * lengths.mean_error()});
    result.checks.push_back({"paths of four segments", fours.mean(), 8.0 / 81, kStandardErrors * fours.mean_error()});
  }
};

}  // namespace

Experiment markov_experiment() { return make_experiment<Markov>(); }

}  // namespace etendue::experiments
