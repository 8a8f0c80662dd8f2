// Path classes of stored light subpaths (photons, virtual lights).
//
// A stored vertex has one state of the automaton that reads from the light. The vertex that looks it up computes, for
// each such state, the part of its own throughput that is compatible with it.
#pragma once
#include <array>
#include <bit>

#include "transport/path_expression/class_join.h"

namespace etendue::transport {

// For each state of a light subpath: the part of a camera path's throughput that counts if both meet at a vertex that
// scatters by one letter or the other.
template <class Color>
struct JoinWeights {
  struct ByLetter {
    Color diffuse{0}, glossy{0}, volume{0};
  };
  std::array<ByLetter, Automaton::kMostStates> by_state;
};

template <class M>
void find_join_weights(const ClassShares<M>& shares, int path, const ClassJoin& join,
                       JoinWeights<typename M::Color>& weights) {
  const Automaton& automaton = shares.automaton();
  const size_t size = join.light().size();
  for (size_t r = 0; r < size; ++r) weights.by_state[r] = {};
  for (Automaton::States states = shares.states(path); states != 0; states &= states - 1) {
    const auto q = static_cast<Automaton::State>(std::countr_zero(states));
    const auto add = [&](Event letter, auto part) {
      const Automaton::State after = automaton.next(q, letter);
      for (size_t r = 1; r < size; ++r)
        if (join.are_compatible(after, static_cast<Automaton::State>(r)))
          weights.by_state[r].*part += shares.share(path, q);
    };
    add(Event::diffuse, &JoinWeights<typename M::Color>::ByLetter::diffuse);
    add(Event::glossy, &JoinWeights<typename M::Color>::ByLetter::glossy);
    if constexpr (M::kScattering) add(Event::volume, &JoinWeights<typename M::Color>::ByLetter::volume);
  }
}

// A state of a path, chosen in proportion to its share, to be stored with a photon. `weight` is the factor of its
// power; black if the path has no share.
template <class Color>
struct DrawnState {
  Automaton::State state = Automaton::kDead;
  Color weight{0};
};

template <class M>
DrawnState<typename M::Color> draw_state(const ClassShares<M>& shares, int path, float random) {
  DrawnState<typename M::Color> drawn;
  float total = 0;
  for (Automaton::States states = shares.states(path); states != 0; states &= states - 1)
    total += average(shares.share(path, static_cast<Automaton::State>(std::countr_zero(states))));
  if (!(total > 0)) return drawn;
  float left = random * total;
  for (Automaton::States states = shares.states(path); states != 0; states &= states - 1) {
    const auto q = static_cast<Automaton::State>(std::countr_zero(states));
    const float part = average(shares.share(path, q));
    if (!(part > 0)) continue;
    drawn = {q, shares.share(path, q) * (total / part)};
    left -= part;
    if (left < 0) break;
  }
  return drawn;
}

}  // namespace etendue::transport
