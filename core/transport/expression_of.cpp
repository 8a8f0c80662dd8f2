// Expressions of automata, by eliminating their states.
#include <map>

#include "transport/path_expression.h"

namespace etendue::transport {
namespace {

// A piece of an expression. Without text it is the empty word alone.
struct Term {
  enum Level { single, sequence, alternatives };
  std::string text;
  Level level = single;
  bool optional = false;  // the empty word belongs to it too

  bool nothing() const { return text.empty(); }
};

// As part of something that binds as tightly as `level`.
std::string shown(const Term& term, Term::Level level) {
  if (term.optional) return "[" + term.text + "]";
  return term.level > level ? "(" + term.text + ")" : term.text;
}

Term either(const Term& a, const Term& b) {
  if (a.nothing() || b.nothing()) {
    Term some = a.nothing() ? b : a;
    // What ends in '*' takes nothing already.
    some.optional = !some.nothing() && !(some.level == Term::single && some.text.back() == '*');
    return some;
  }
  if (a.text == b.text) return {a.text, a.level, a.optional || b.optional};
  return {a.text + "|" + b.text, Term::alternatives, a.optional || b.optional};
}

Term sequence(const Term& a, const Term& b) {
  if (a.nothing() || b.nothing()) return a.nothing() ? b : a;
  // XX* is X+.
  if (b.level == Term::single && b.text == shown(a, Term::single) + "*") return {b.text.substr(0, b.text.size() - 1) + "+"};
  return {shown(a, Term::sequence) + shown(b, Term::sequence), Term::sequence};
}

Term any_number(const Term& term) {
  if (term.nothing()) return term;
  return {shown({term.text, term.level}, Term::single) + "*"};
}

// The letters of a set as one term.
Term letters_term(Letters letters) {
  if (letters == kScattering) return {"."};
  Term term;
  for (size_t e = 0; e < kEvents; ++e)
    if (letters >> e & 1) term = term.nothing() ? Term{{kLetters[e]}} : either(term, {{kLetters[e]}});
  return term;
}

// States that lead to each other by terms. kBegin and kEnd stand outside.
class Graph {
 public:
  explicit Graph(const Automaton& automaton) {
    edges_[{kBegin, automaton.start()}] = {};
    for (size_t q = 1; q < automaton.size(); ++q) {
      const auto from = static_cast<Automaton::State>(q);
      std::map<int, Letters> targets;
      for (size_t e = 0; e < kEvents; ++e)
        if (const auto to = automaton.next(from, static_cast<Event>(e)); to != Automaton::kDead)
          targets[to] = static_cast<Letters>(targets[to] | letters_of(static_cast<Event>(e)));
      for (const auto& [to, letters] : targets) edges_[{from, to}] = letters_term(letters);
      if (automaton.accepts(from)) edges_[{from, kEnd}] = {};
      open_.push_back(from);
    }
  }

  std::string expression() {
    while (!open_.empty()) eliminate(cheapest());
    return edges_.at({kBegin, kEnd}).text;
  }

 private:
  static constexpr int kBegin = -1, kEnd = -2;

  // That with the fewest ways through.
  int cheapest() const {
    int best = open_.front();
    size_t least = SIZE_MAX;
    for (const int q : open_) {
      size_t in = 0, out = 0;
      for (const auto& [ends, term] : edges_) {
        in += ends.second == q && ends.first != q;
        out += ends.first == q && ends.second != q;
      }
      if (in * out < least) least = in * out, best = q;
    }
    return best;
  }

  void eliminate(int q) {
    Term loop;
    if (const auto own = edges_.find({q, q}); own != edges_.end()) loop = any_number(own->second);
    const auto before = edges_;
    for (const auto& [in, first] : before)
      for (const auto& [out, last] : before) {
        if (in.second != q || out.first != q || in.first == q || out.second == q) continue;
        const Term way = sequence(sequence(first, loop), last);
        const auto [at, added] = edges_.try_emplace({in.first, out.second}, way);
        if (!added) at->second = either(at->second, way);
      }
    std::erase_if(edges_, [&](const auto& edge) { return edge.first.first == q || edge.first.second == q; });
    std::erase(open_, q);
  }

  std::map<std::pair<int, int>, Term> edges_;
  std::vector<int> open_;
};

}  // namespace

std::string expression_of(const Automaton& automaton) { return Graph(automaton).expression(); }

}  // namespace etendue::transport
