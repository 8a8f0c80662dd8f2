// Conversion of automata to expressions by state elimination [Brzozowski and McCluskey 1963].
#include <map>
#include <vector>

#include "transport/path_expression/path_expression.h"

namespace etendue::transport {
namespace {

// A sequence of pieces: letters and bracketed expressions, either with '*' or '+' appended. Empty: the empty word.
using Term = std::vector<std::string>;

std::string text_of(const Term& term) {
  std::string text;
  for (const auto& piece : term) text += piece;
  return text;
}

// Whether the term is a single bracketed choice, which can be repeated as it is.
bool is_choice(const Term& term) { return term.size() == 1 && term[0].front() == '(' && term[0].back() == ')'; }
bool is_optional(const Term& term) { return term.size() == 1 && term[0].front() == '['; }

// The term as one side of '|'.
std::string side_of(const Term& term) {
  return is_choice(term) ? term[0].substr(1, term[0].size() - 2) : text_of(term);
}

Term optional(const Term& term) {
  // Terms that end in '*' or ']' already accept the empty word.
  const bool may_be_empty = term.size() == 1 && (term[0].back() == '*' || term[0].back() == ']');
  if (may_be_empty) return term;
  if (term.size() == 1 && term[0].back() == '+') return {term[0].substr(0, term[0].size() - 1) + "*"};
  return {"[" + side_of(term) + "]"};
}

// Factors out common prefixes and suffixes: DL|L is [D]L.
Term either(Term a, Term b) {
  Term first, last;
  while (!a.empty() && !b.empty() && a.front() == b.front()) {
    first.push_back(a.front());
    a.erase(a.begin());
    b.erase(b.begin());
  }
  while (!a.empty() && !b.empty() && a.back() == b.back()) {
    last.insert(last.begin(), a.back());
    a.pop_back();
    b.pop_back();
  }
  if (!a.empty() || !b.empty()) {
    const Term choice = a.empty()   ? optional(b)
                        : b.empty() ? optional(a)
                                    : Term{"(" + side_of(a) + "|" + side_of(b) + ")"};
    first.insert(first.end(), choice.begin(), choice.end());
  }
  first.insert(first.end(), last.begin(), last.end());
  return first;
}

// Concatenation; XX* becomes X+.
Term sequence(Term a, const Term& b) {
  for (const auto& piece : b) {
    if (!a.empty() && piece == a.back() + "*")
      a.back() += "+";
    else
      a.push_back(piece);
  }
  return a;
}

Term any_number(const Term& term) {
  if (term.empty()) return term;
  if (is_optional(term)) return any_number({"(" + term[0].substr(1, term[0].size() - 2) + ")"});
  const bool single = term.size() == 1 && (term[0].size() == 1 || is_choice(term));
  return {(single ? term[0] : "(" + text_of(term) + ")") + "*"};
}

// A set of letters as one term.
Term letters_term(Letters letters, bool volumes) {
  const Letters any = volumes ? kScattering : kScattering & static_cast<Letters>(~letters_of(Event::volume));
  if (letters == any) return {"."};
  Term term;
  for (size_t e = 0; e < kEvents; ++e)
    if (letters >> e & 1) term = term.empty() ? Term{{kLetters[e]}} : either(term, {{kLetters[e]}});
  return term;
}

// A graph of states with terms as transitions. kBegin and kEnd are extra states.
class Graph {
 public:
  Graph(const Automaton& automaton, bool volumes) {
    edges_[{kBegin, automaton.start()}] = {};
    for (size_t q = 1; q < automaton.size(); ++q) {
      const auto from = static_cast<Automaton::State>(q);
      std::map<int, Letters> targets;
      for (size_t e = 0; e < kEvents; ++e)
        if (const auto to = automaton.next(from, static_cast<Event>(e)); to != Automaton::kDead)
          targets[to] = static_cast<Letters>(targets[to] | letters_of(static_cast<Event>(e)));
      for (const auto& [to, letters] : targets) edges_[{from, to}] = letters_term(letters, volumes);
      if (automaton.accepts(from)) edges_[{from, kEnd}] = {};
      open_.push_back(from);
    }
  }

  std::string expression() {
    while (!open_.empty()) eliminate(cheapest());
    return text_of(edges_.at({kBegin, kEnd}));
  }

 private:
  static constexpr int kBegin = -1, kEnd = -2;

  // The state with the fewest pairs of incoming and outgoing transitions.
  int cheapest() const {
    int best = open_.front();
    size_t least = SIZE_MAX;
    for (const int q : open_) {
      size_t in = 0, out = 0;
      for (const auto& [ends, term] : edges_) {
        in += ends.second == q && ends.first != q;
        out += ends.first == q && ends.second != q;
      }
      if (in * out < least) {
        least = in * out;
        best = q;
      }
    }
    return best;
  }

  void eliminate(int q) {
    Term loop;
    if (const auto edge = edges_.find({q, q}); edge != edges_.end()) loop = any_number(edge->second);
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

std::string expression_of(const Automaton& automaton, bool volumes) { return Graph(automaton, volumes).expression(); }

}  // namespace etendue::transport
