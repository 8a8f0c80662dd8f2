// Finite automata over the letters of light paths.
//
// A Pattern is a nondeterministic automaton, built from parts as a parser reads an expression [Thompson 1968].
// `Automaton::of` converts it to the minimal deterministic automaton of the same language (subset construction [Rabin
// and Scott 1959]; minimisation [Moore 1956]). States are numbered in breadth-first order, so that two automata are
// equal exactly if they accept the same words.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bsdf/lobe.h"

namespace etendue::transport {

// Events along a path, in the order of the automaton's transitions.
enum class Event : uint8_t { camera, light, diffuse, glossy, specular, volume };
inline constexpr int kEvents = 6;
inline constexpr std::string_view kLetters = "ELDGSV";

inline char letter_of(Event event) { return kLetters[static_cast<size_t>(event)]; }
inline Event event_of(ScatterType scatter) { return static_cast<Event>(static_cast<int>(scatter) + 2); }

// A set of letters.
using Letters = uint8_t;
inline Letters letters_of(Event event) { return static_cast<Letters>(1U << static_cast<unsigned>(event)); }
inline constexpr Letters kScattering = 0b111100;

// A nondeterministic automaton, built from parts.
class Pattern {
 public:
  // A part with one entry and one exit. The operations below consume their operands: each part may be used once.
  struct Part {
    int entry, exit;
  };

  Part one_of(Letters letters);
  Part sequence(Part first, Part second);
  Part either(Part a, Part b);
  Part optional(Part part);
  Part at_least_once(Part part);

 private:
  friend class Automaton;
  // A transition to `to` on the letters of the set, and empty transitions to `free`.
  struct Node {
    Letters letters = 0;
    int to = -1;
    std::array<int, 2> free{-1, -1};
  };
  int add();
  void connect(int from, int to);

  std::vector<Node> nodes_;
};

// Deterministic, complete and minimal.
class Automaton {
 public:
  using State = uint8_t;
  // The state from which no word is accepted. It always exists, even if it is unreachable.
  static constexpr State kDead = 0;
  // Including the dead state; a set of states fits a word of 64 bits.
  static constexpr size_t kMostStates = 64;

  // The automaton of a pattern; nothing if it has more than kMostStates states, or too many before minimisation.
  static std::optional<Automaton> of(const Pattern& pattern, Pattern::Part whole);
  // The words that both accept.
  static std::optional<Automaton> intersection(const Automaton& a, const Automaton& b);
  // The reversed words.
  static std::optional<Automaton> reversal(const Automaton& a);
  // The words that `a` accepts and `b` does not.
  static std::optional<Automaton> difference(const Automaton& a, const Automaton& b);

  // A set of states, one bit for each.
  using States = uint64_t;
  static_assert(kMostStates <= 64);
  static States bit(State state) { return States{1} << state; }
  // The states from which the letter leads to a state of `set`.
  States before(States set, Event event) const;
  States accepting() const;

  State start() const { return start_; }
  State next(State state, Event event) const { return rows_[state].next[static_cast<size_t>(event)]; }
  bool accepts(State state) const { return rows_[state].accepting; }
  size_t size() const { return rows_.size(); }

  // Whether it accepts no word.
  bool empty() const { return start_ == kDead; }
  bool accepts(std::string_view word) const;

  friend bool operator==(const Automaton&, const Automaton&) = default;

 private:
  struct Row {
    std::array<State, kEvents> next{};
    bool accepting = false;
    friend bool operator==(const Row&, const Row&) = default;
  };
  // A state before minimisation; state 0 is the start.
  struct WideRow {
    std::array<int, kEvents> next{};
    bool accepting = false;
  };
  static std::optional<Automaton> minimal(const std::vector<WideRow>& rows);
  // The product automaton; `accepts` combines the acceptance of both.
  static std::optional<Automaton> product(const Automaton& a, const Automaton& b, bool (*accepts)(bool, bool));

  std::vector<Row> rows_{1};
  State start_ = kDead;
};

}  // namespace etendue::transport
