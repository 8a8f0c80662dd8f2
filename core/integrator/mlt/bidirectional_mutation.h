// The bidirectional mutation: replaces a part of a path.     [Lang, sec. 9.4.2, eq. 9.119-9.122, corrected;
//                                                            Veach and Guibas 1997, sec. 5.1, 5.2]
//
// The vertices between l and m are deleted, and new ones are sampled by subpaths from either end and a connection. The
// density of the proposal sums over all subpath lengths that yield the same path: T(x -> y) / f(y) is
//
//   p_d[l, m]  p_a(new edges)  sum over connecting edges of p_split / C                       [Lang, eq. 9.122]
//
// where C is the contribution of bidirectional path tracing to the path without MIS weights. l = -1 and m = k + 1 lie
// beyond the ends.
#pragma once
#include "integrator/mlt/path_space.h"

namespace etendue::integrator {

// 2^-n, with n limited to 62: smaller values do not matter in the sums.
constexpr double half_to(int n) { return 1 / static_cast<double>(uint64_t{1} << std::min(n, 62)); }

// Unnormalised probability of adding `change` more edges than were deleted.
struct EdgeChangeDistribution {
  static constexpr int kMaxChange = 16;

  static constexpr double at(int change) {
    const int n = change < 0 ? -change : change;
    return n == 0 ? 0.5 : n == 1 ? 0.15 : 0.2 * half_to(n);
  }
  // The sum over all changes from first to last.
  static double sum(int first, int last) {
    return kBelow[static_cast<size_t>(last + kMaxChange + 1)] - kBelow[static_cast<size_t>(first + kMaxChange)];
  }

 private:
  // Prefix sums: of all changes below i - kMaxChange.
  static const std::array<double, 2 * kMaxChange + 2> kBelow;
};
inline constexpr std::array<double, 2 * EdgeChangeDistribution::kMaxChange + 2> EdgeChangeDistribution::kBelow = [] {
  std::array<double, 2 * kMaxChange + 2> below{};
  for (int i = 0; i <= 2 * kMaxChange; ++i)
    below[static_cast<size_t>(i + 1)] = below[static_cast<size_t>(i)] + at(i - kMaxChange);
  return below;
}();

// The distributions of the numbers of deleted and added edges.
class EdgeCounts {
 public:
  // `max_edges` of a whole path; 0: no limit.
  explicit EdgeCounts(int max_edges) : max_edges_(max_edges) {}

  struct Deletion {
    int edges, l;
  };
  Deletion choose_deletion(int path, ChainRandom& random) const {
    double u = random.next() * sum_of_deletions(path);
    int edges = 1;
    while (edges < path + 2 && !(u < deletion(edges))) u -= deletion(edges++);
    const int choices = deletions(path, edges);
    const int i = std::min(static_cast<int>(random.next() * static_cast<float>(choices)), choices - 1);
    return {edges, edges == 1 ? i : i - 1};
  }
  // The probability of one deletion of so many edges, at a given place.
  static double probability_of_deletion(int path, int edges) {
    return deletion(edges) / sum_of_deletions(path) / deletions(path, edges);
  }

  // The number of edges that replace the deleted ones; `min_edges` is one more than the number of vertices that must be
  // sampled.
  int choose_addition(int path, int deleted, int min_edges, ChainRandom& random) const {
    const int first = std::max(min_edges, deleted - EdgeChangeDistribution::kMaxChange),
              last = last_addition(path, deleted);
    double u = random.next() * EdgeChangeDistribution::sum(first - deleted, last - deleted);
    int edges = first;
    while (edges < last && !(u < EdgeChangeDistribution::at(edges - deleted)))
      u -= EdgeChangeDistribution::at(edges++ - deleted);
    return edges;
  }
  double probability_of_addition(int path, int deleted, int min_edges, int added) const {
    const int first = std::max(min_edges, deleted - EdgeChangeDistribution::kMaxChange),
              last = last_addition(path, deleted);
    if (added < first || added > last) return 0;
    return EdgeChangeDistribution::at(added - deleted) / EdgeChangeDistribution::sum(first - deleted, last - deleted);
  }

 private:
  // p_d,1 [Veach and Guibas 1997]: short parts are cheap, and small changes are accepted more often.
  static double deletion(int edges) { return edges == 1 ? 0.25 : edges == 2 ? 0.5 : half_to(edges); }
  static double sum_of_deletions(int path) { return 1 - half_to(path + 2); }
  // The number of places of a deletion: a single edge beyond either end is not part of the path.
  static int deletions(int path, int edges) { return edges == 1 ? path : path + 3 - edges; }

  int last_addition(int path, int deleted) const {
    return max_edges_ > 0 ? std::min(deleted + EdgeChangeDistribution::kMaxChange, max_edges_ - path + deleted)
                          : deleted + EdgeChangeDistribution::kMaxChange;
  }

  int max_edges_;
};

// A part of a path: `vertices` vertices between l and m.
struct PathPart {
  int l, m;
  int edges() const { return m - l; }
  int vertices() const { return m - l - 1; }
  // The minimum number of edges: a part beyond an end of the path of k edges must contain x_0 or the lens.
  int least_edges(int k) const { return 1 + (l < 0 ? 1 : 0) + (m > k ? 1 : 0); }
  // The number of ways to divide the vertices between the subpaths of either end; that from the camera begins with the
  // lens.
  int splits(int k) const { return vertices() + (m > k ? 0 : 1); }
};

// Samples the vertices of the part. All other vertices are given, as is the lens point unless it belongs to the part.
template <class M>
bool sample_part(const PathPart& part, PathSpace<M>& space, ChainRandom& random, LightPath<M>& path) {
  const int k = path.edges(), splits = part.splits(k);
  // The last vertex of the light subpath.
  const int c = part.l + std::min(static_cast<int>(random.next() * static_cast<float>(splits)), splits - 1);
  const bool for_receiver = part.l < 0 && c == 0 && k > 1 && chooses_lights_for_receivers(space.scene());
  if (part.l < 0 && c >= 0 && !for_receiver && !space.sample_light(random, path)) return false;
  for (int i = std::max(part.l, 0); i < c; ++i)
    if (!(i == 0 ? space.trace_from_light(random, path) : space.scatter_to_camera(i, random, path))) return false;
  const Vec2 lens = part.m > k ? random.next_2d() : path.lens;
  path.lens = lens;
  for (int i = std::min(part.m, k); i > c + 1; --i)
    if (!(i == k ? space.trace_from_camera(space.image_point(random.next_2d()), lens, random, path)
                 : space.scatter_to_light(i, random, path)))
      return false;
  if (for_receiver) {
    const LightReceiver receiver = receiver_of_light(path);
    if (!space.sample_light(random, path, &receiver)) return false;
  }
  if (c >= 0 && !space.connect(c, path)) return false;
  return space.evaluate(part.l, part.m, path) && (c < 0 || space.visible(c, random, path));
}

// The density of the part, divided by f.
template <class M>
double density_over_f(const PathPart& part, const PathSpace<M>& space, const LightPath<M>& path) {
  const double technique_probability = 1.0 / part.splits(path.edges());
  // Connections to x_0 choose the light for x_1; rays from x_0 start by its power.
  const double choice = part.l < 0 ? double{choice_for_receiver(space.scene(), path)} : 1;
  return path.density_between(part.l, part.m, double{space.image_area()}, [&](int c) {
    return c == 0 && part.l < 0 ? technique_probability * choice : technique_probability;
  });
}

// The deleted part of x and the added part of y.
struct Exchange {
  PathPart deleted, added;
};

// T(x -> y) / f(y).
template <class M>
double proposal_density_over_f(const EdgeCounts& counts, const PathSpace<M>& space, const LightPath<M>& x,
                               const Exchange& e, const LightPath<M>& y) {
  const int k = x.edges(), deleted = e.deleted.edges();
  return EdgeCounts::probability_of_deletion(k, deleted) *
         counts.probability_of_addition(k, deleted, e.deleted.least_edges(k), e.added.edges()) *
         density_over_f(e.added, space, y);
}

// Proposes y from x; nothing if y has no contribution.
template <class M>
std::optional<Exchange> exchange(const EdgeCounts& counts, PathSpace<M>& space, const LightPath<M>& x,
                                 ChainRandom& random, LightPath<M>& y) {
  const int k = x.edges();
  const EdgeCounts::Deletion deletion = counts.choose_deletion(k, random);
  Exchange e;
  e.deleted = {deletion.l, deletion.l + deletion.edges};
  const int added = counts.choose_addition(k, deletion.edges, e.deleted.least_edges(k), random);
  e.added = {deletion.l, deletion.l + added};
  y.resize(k - deletion.edges + added);
  y.copy_ends(x);
  for (int i = 0; i <= e.deleted.l; ++i) y[i] = x[i];
  for (int i = e.deleted.m; i < k; ++i) y[i - e.deleted.m + e.added.m] = x[i];
  // An entirely new path samples a new time.
  if (e.added.l < 0 && e.added.m > y.edges()) y.time = space.choose_time(random);
  if (!sample_part(e.added, space, random, y)) return {};
  return e;
}

}  // namespace etendue::integrator
