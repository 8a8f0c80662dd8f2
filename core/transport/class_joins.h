// Paths that are put together from a walk from the camera and one from a light.
//
// Each walk has read the path from its own end with an automaton of its own (class_shares.h). What a walk from the
// light has read, the rest of a path, is accepted from some states of the camera's automaton: all words that lead the
// light's automaton into one state are accepted from the same ones, because it has as few states as can be. So the two
// ends fit if the camera's walk, after the letter of the vertex where they meet, is in one of them.
#pragma once
#include <array>
#include <bit>

#include "transport/class_shares.h"

namespace etendue::transport {

class ClassJoins {
 public:
  using State = Automaton::State;
  using States = Automaton::States;

  // `paths` must be an expression of paths.
  explicit ClassJoins(const PathExpression& paths) {
    const Automaton &camera = paths.automaton(), &light = *paths.from_light();
    std::array<bool, Automaton::kMostStates> known{};
    std::array<State, Automaton::kMostStates> open;
    size_t count = 0;
    const auto find = [&](State state, States accepted) {
      if (known[state]) return;
      known[state] = true, accepted_[state] = accepted, open[count++] = state;
    };
    known[Automaton::kDead] = true;
    find(light.start(), camera.accepting());
    for (size_t i = 0; i < count; ++i)
      for (int e = 0; e < kEvents; ++e) {
        const auto event = static_cast<Event>(e);
        find(light.next(open[i], event), camera.before(accepted_[open[i]], event));
      }
    size_ = light.size();
  }

  // Of the light's automaton.
  size_t size() const { return size_; }
  // The states of the camera's automaton from which what led there is accepted.
  States accepted_from(State light) const { return accepted_[light]; }

 private:
  std::array<States, Automaton::kMostStates> accepted_{};
  size_t size_ = 0;
};

// For each state of a walk from the light: the part of a camera walk's throughput that counts if both meet at a vertex
// that scatters by one letter or the other.
template <class Color>
struct JoinWeights {
  struct ByLetter {
    Color diffuse{0}, glossy{0};
  };
  std::array<ByLetter, Automaton::kMostStates> of;
};

template <class M>
void find_join_weights(const ClassShares<M>& shares, int path, const ClassJoins& joins,
                       JoinWeights<typename M::Color>& weights) {
  const Automaton& automaton = shares.automaton();
  for (size_t r = 0; r < joins.size(); ++r) weights.of[r] = {};
  for (Automaton::States states = shares.states(path); states != 0; states &= states - 1) {
    const auto q = static_cast<Automaton::State>(std::countr_zero(states));
    const auto add = [&](Event letter, auto ByLetter) {
      const Automaton::States after = Automaton::bit(automaton.next(q, letter));
      for (size_t r = 1; r < joins.size(); ++r)
        if (joins.accepted_from(static_cast<Automaton::State>(r)) & after)
          weights.of[r].*ByLetter += shares.share(path, q);
    };
    add(Event::diffuse, &JoinWeights<typename M::Color>::ByLetter::diffuse);
    add(Event::glossy, &JoinWeights<typename M::Color>::ByLetter::glossy);
  }
}

// One of the states that a walk is in, chosen by its share: what a photon remembers. `weight` is what its power is
// multiplied by; black if nothing of the walk counts.
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
