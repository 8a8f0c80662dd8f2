// Finite automata over the letters of light paths.
//
// A Pattern is built piece by piece, as a parser reads an expression (Thompson 1968); `Automaton::of` makes the
// smallest deterministic automaton that accepts the same words (subset construction; Moore 1956). States are numbered
// in the order in which a walk over all words meets them, so that two automata are equal exactly if they accept the
// same words.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bsdf/lobe.h"

namespace etendue::transport {

// What happens to light along a path, in the order in which automata count it.
enum class Event : uint8_t { camera, light, diffuse, glossy, specular };
inline constexpr int kEvents = 5;
inline constexpr std::string_view kLetters = "ELDGS";

inline char letter_of(Event event) { return kLetters[static_cast<size_t>(event)]; }
inline Event event_of(ScatterType scatter) { return static_cast<Event>(static_cast<int>(scatter) + 2); }

// A set of letters.
using Letters = uint8_t;
inline Letters letters_of(Event event) { return static_cast<Letters>(1U << static_cast<unsigned>(event)); }
inline constexpr Letters kScattering = 0b11100;

// A nondeterministic automaton that grows from its parts.
class Pattern {
 public:
  // A part with one entry and one exit. It may be used once: the operations below take it over.
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
  // On a letter of the set to `to`, and at any time to each of `free`.
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
  // From here no word is accepted any more. It is always there, even if nothing leads to it.
  static constexpr State kDead = 0;
  // The dead state included: the set of states that are alive fits a word of 64 bits.
  static constexpr size_t kMostStates = 64;

  // Nothing if it would have more than kMostStates states, or pass through too many on the way there.
  static std::optional<Automaton> of(const Pattern& pattern, Pattern::Part whole);
  // The words that both accept.
  static std::optional<Automaton> intersection(const Automaton& a, const Automaton& b);
  // The words that are accepted if they are read from their ends.
  static std::optional<Automaton> reversal(const Automaton& a);
  // The words that `a` accepts and `b` does not.
  static std::optional<Automaton> difference(const Automaton& a, const Automaton& b);

  // A set of states, one bit for each.
  using States = uint64_t;
  static_assert(kMostStates <= 64);
  static States bit(State state) { return States{1} << state; }
  // Those that the letter takes to a state of `set`.
  States before(States set, Event event) const;
  States accepting() const;

  State start() const { return start_; }
  State next(State state, Event event) const { return rows_[state].next[static_cast<size_t>(event)]; }
  bool accepts(State state) const { return rows_[state].accepting; }
  size_t size() const { return rows_.size(); }

  // No word at all.
  bool empty() const { return start_ == kDead; }
  bool accepts(std::string_view word) const;

  friend bool operator==(const Automaton&, const Automaton&) = default;

 private:
  struct Row {
    std::array<State, kEvents> next{};
    bool accepting = false;
    friend bool operator==(const Row&, const Row&) = default;
  };
  // Before it is minimal; state 0 is the start.
  struct WideRow {
    std::array<int, kEvents> next{};
    bool accepting = false;
  };
  static std::optional<Automaton> minimal(const std::vector<WideRow>& rows);
  // Of both at once; `accepts` says what becomes of their answers.
  static std::optional<Automaton> product(const Automaton& a, const Automaton& b, bool (*accepts)(bool, bool));

  std::vector<Row> rows_{1};
  State start_ = kDead;
};

}  // namespace etendue::transport
