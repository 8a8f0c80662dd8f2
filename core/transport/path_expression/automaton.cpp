#include "transport/path_expression/automaton.h"

#include <algorithm>
#include <map>

namespace etendue::transport {
namespace {

// Bound of the subset construction, which is exponential in the worst case.
constexpr size_t kMaxSubsets = 1024;

// Assigns consecutive numbers to values in the order of their first occurrence.
template <class T>
class Numbering {
 public:
  int operator()(const T& thing) {
    const auto [at, added] = numbers_.emplace(thing, static_cast<int>(things_.size()));
    if (added) things_.push_back(thing);
    return at->second;
  }
  size_t size() const { return things_.size(); }
  T operator[](size_t i) const { return things_[i]; }

 private:
  std::map<T, int> numbers_;
  std::vector<T> things_;
};

}  // namespace

int Pattern::add() {
  nodes_.emplace_back();
  return static_cast<int>(nodes_.size()) - 1;
}

void Pattern::connect(int from, int to) {
  auto& free = nodes_[static_cast<size_t>(from)].free;
  (free[0] < 0 ? free[0] : free[1]) = to;
}

Pattern::Part Pattern::one_of(Letters letters) {
  const Part part{add(), add()};
  nodes_[static_cast<size_t>(part.entry)].letters = letters;
  nodes_[static_cast<size_t>(part.entry)].to = part.exit;
  return part;
}

Pattern::Part Pattern::sequence(Part first, Part second) {
  connect(first.exit, second.entry);
  return {first.entry, second.exit};
}

Pattern::Part Pattern::either(Part a, Part b) {
  const Part part{add(), add()};
  connect(part.entry, a.entry);
  connect(part.entry, b.entry);
  connect(a.exit, part.exit);
  connect(b.exit, part.exit);
  return part;
}

Pattern::Part Pattern::optional(Part inner) {
  const Part part{add(), add()};
  connect(part.entry, inner.entry);
  connect(part.entry, part.exit);
  connect(inner.exit, part.exit);
  return part;
}

Pattern::Part Pattern::at_least_once(Part inner) {
  const Part part{add(), add()};
  connect(part.entry, inner.entry);
  connect(inner.exit, inner.entry);
  connect(inner.exit, part.exit);
  return part;
}

std::optional<Automaton> Automaton::of(const Pattern& pattern, Pattern::Part whole) {
  const auto& nodes = pattern.nodes_;
  // The sorted set of nodes that are reachable by empty transitions.
  const auto closure = [&](std::vector<int> open) {
    std::vector<bool> seen(nodes.size(), false);
    std::vector<int> reached;
    while (!open.empty()) {
      const auto node = static_cast<size_t>(open.back());
      open.pop_back();
      if (seen[node]) continue;
      seen[node] = true;
      reached.push_back(static_cast<int>(node));
      for (const int next : nodes[node].free)
        if (next >= 0) open.push_back(next);
    }
    std::sort(reached.begin(), reached.end());
    return reached;
  };
  Numbering<std::vector<int>> subsets;
  subsets(closure({whole.entry}));
  std::vector<WideRow> rows;
  for (size_t i = 0; i < subsets.size(); ++i) {
    const std::vector<int> subset = subsets[i];
    WideRow row;
    for (size_t e = 0; e < kEvents; ++e) {
      std::vector<int> targets;
      for (const int node : subset)
        if (const auto& n = nodes[static_cast<size_t>(node)]; n.letters >> e & 1) targets.push_back(n.to);
      row.next[e] = subsets(closure(std::move(targets)));
    }
    row.accepting = std::binary_search(subset.begin(), subset.end(), whole.exit);
    rows.push_back(row);
    if (subsets.size() > kMaxSubsets) return {};
  }
  return minimal(rows);
}

std::optional<Automaton> Automaton::intersection(const Automaton& a, const Automaton& b) {
  return product(a, b, [](bool in_a, bool in_b) { return in_a && in_b; });
}

std::optional<Automaton> Automaton::difference(const Automaton& a, const Automaton& b) {
  return product(a, b, [](bool in_a, bool in_b) { return in_a && !in_b; });
}

Automaton::States Automaton::before(States set, Event event) const {
  States before = 0;
  for (size_t i = 0; i < rows_.size(); ++i)
    if (set >> next(static_cast<State>(i), event) & 1) before |= bit(static_cast<State>(i));
  return before;
}

Automaton::States Automaton::accepting() const {
  States accepting = 0;
  for (size_t i = 0; i < rows_.size(); ++i)
    if (rows_[i].accepting) accepting |= bit(static_cast<State>(i));
  return accepting;
}

// A state of the reversal is a set of states: those from which the reversed prefix is accepted.
std::optional<Automaton> Automaton::reversal(const Automaton& a) {
  Numbering<States> sets;
  sets(a.accepting());
  std::vector<WideRow> rows;
  for (size_t i = 0; i < sets.size(); ++i) {
    const States set = sets[i];
    WideRow row;
    for (size_t e = 0; e < kEvents; ++e) row.next[e] = sets(a.before(set, static_cast<Event>(e)));
    row.accepting = set >> a.start() & 1;
    rows.push_back(row);
    if (sets.size() > kMaxSubsets) return {};
  }
  return minimal(rows);
}

std::optional<Automaton> Automaton::product(const Automaton& a, const Automaton& b, bool (*accepts)(bool, bool)) {
  Numbering<std::pair<State, State>> pairs;
  pairs({a.start(), b.start()});
  std::vector<WideRow> rows;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const auto [p, q] = pairs[i];
    WideRow row;
    for (size_t e = 0; e < kEvents; ++e) row.next[e] = pairs({a.rows_[p].next[e], b.rows_[q].next[e]});
    row.accepting = accepts(a.accepts(p), b.accepts(q));
    rows.push_back(row);
  }
  return minimal(rows);
}

// Moore's algorithm: partitions the states by the words of length 0, 1, ... that they accept, until the partition is
// stable.
std::optional<Automaton> Automaton::minimal(const std::vector<WideRow>& rows) {
  std::vector<int> kind(rows.size());
  for (size_t i = 0; i < rows.size(); ++i) kind[i] = rows[i].accepting ? 1 : 0;
  const auto kind_after = [&](const WideRow& row, size_t e) { return kind[static_cast<size_t>(row.next[e])]; };
  for (size_t kinds = 0;;) {
    Numbering<std::array<int, kEvents + 1>> finer;
    std::vector<int> next(rows.size());
    for (size_t i = 0; i < rows.size(); ++i) {
      std::array<int, kEvents + 1> signature{kind[i]};
      for (size_t e = 0; e < kEvents; ++e) signature[e + 1] = kind_after(rows[i], e);
      next[i] = finer(signature);
    }
    kind = std::move(next);
    if (finer.size() == kinds) break;
    kinds = finer.size();
  }
  // The dead class rejects and leads only to itself.
  int dead = -1;
  for (size_t i = 0; i < rows.size(); ++i) {
    bool stays = !rows[i].accepting;
    for (size_t e = 0; e < kEvents; ++e) stays = stays && kind_after(rows[i], e) == kind[i];
    if (stays) dead = kind[i];
  }
  // Numbers in breadth-first order from the start, after the dead state.
  Numbering<int> order;
  std::map<int, size_t> example;
  for (size_t i = 0; i < rows.size(); ++i) example.emplace(kind[i], i);
  order(dead);
  order(kind[0]);
  for (size_t i = 0; i < order.size(); ++i)
    for (size_t e = 0; order[i] != dead && e < kEvents; ++e) order(kind_after(rows[example.at(order[i])], e));
  if (order.size() > kMostStates) return {};

  Automaton result;
  result.start_ = static_cast<State>(order(kind[0]));
  result.rows_.assign(order.size(), Row{});
  for (size_t i = 1; i < order.size(); ++i) {
    const WideRow& row = rows[example.at(order[i])];
    result.rows_[i].accepting = row.accepting;
    for (size_t e = 0; e < kEvents; ++e) result.rows_[i].next[e] = static_cast<State>(order(kind_after(row, e)));
  }
  return result;
}

bool Automaton::accepts(std::string_view word) const {
  State state = start_;
  for (const char c : word) {
    const size_t event = kLetters.find(c);
    if (event == std::string_view::npos) return false;
    state = next(state, static_cast<Event>(event));
  }
  return accepts(state);
}

}  // namespace etendue::transport
