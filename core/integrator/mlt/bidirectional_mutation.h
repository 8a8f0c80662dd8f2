// The bidirectional mutation: deletes a part of a path and puts another one there.     thesis 9.4.4, (9.119)-(9.122),
// erratum E29; Veach & Guibas 1997, 5.1, 5.2
//
// Between a kept vertex l and a kept vertex m new ones are found, by walks from either end and a connection. As many
// walks as can find the same path take part in the density of the proposal: T(X -> Y) / f(Y) is
//
//   p_d[l, m]  p_a(new edges)  sum over connecting edges of p_split / C                             (9.122)
//
// where C is what bidirectional path tracing would give the path without weights. l = -1 and m = k + 1 lie beyond the
// ends.
#pragma once
#include "integrator/mlt/path_space.h"

namespace etendue::integrator {

// 2^-n; what is smaller than anything that it is added to may be a little larger.
constexpr double half_to(int n) { return 1 / static_cast<double>(uint64_t{1} << std::min(n, 62)); }

// How often so many more edges come than go, but for a factor.
struct ChangeLaw {
  static constexpr int kMost = 16;

  static constexpr double at(int change) {
    const int n = change < 0 ? -change : change;
    return n == 0 ? 0.5 : n == 1 ? 0.15 : 0.2 * half_to(n);
  }
  // Of all changes from first to last.
  static double sum(int first, int last) {
    return kBelow[static_cast<size_t>(last + kMost + 1)] - kBelow[static_cast<size_t>(first + kMost)];
  }

 private:
  // Sums of all below i - kMost.
  static const std::array<double, 2 * kMost + 2> kBelow;
};
inline constexpr std::array<double, 2 * ChangeLaw::kMost + 2> ChangeLaw::kBelow = [] {
  std::array<double, 2 * kMost + 2> below{};
  for (int i = 0; i <= 2 * kMost; ++i)
    below[static_cast<size_t>(i + 1)] = below[static_cast<size_t>(i)] + at(i - kMost);
  return below;
}();

// How many edges go and how many come.
class EdgeCounts {
 public:
  // `most` edges of a whole path; 0 is no limit.
  explicit EdgeCounts(int most) : most_(most) {}

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
  // Of one deletion: so many of the path's edges, somewhere.
  static double probability_of_deletion(int path, int edges) {
    return deletion(edges) / sum_of_deletions(path) / deletions(path, edges);
  }

  // How many edges come for those that go; `least` is one more than the vertices that must come.
  int choose_addition(int path, int deleted, int least, ChainRandom& random) const {
    const int first = std::max(least, deleted - ChangeLaw::kMost), last = last_addition(path, deleted);
    double u = random.next() * ChangeLaw::sum(first - deleted, last - deleted);
    int edges = first;
    while (edges < last && !(u < ChangeLaw::at(edges - deleted))) u -= ChangeLaw::at(edges++ - deleted);
    return edges;
  }
  double probability_of_addition(int path, int deleted, int least, int added) const {
    const int first = std::max(least, deleted - ChangeLaw::kMost), last = last_addition(path, deleted);
    if (added < first || added > last) return 0;
    return ChangeLaw::at(added - deleted) / ChangeLaw::sum(first - deleted, last - deleted);
  }

 private:
  // p_1: short parts are cheap, and what changes little is accepted more often.
  static double deletion(int edges) { return edges == 1 ? 0.25 : edges == 2 ? 0.5 : half_to(edges); }
  static double sum_of_deletions(int path) { return 1 - half_to(path + 2); }
  // Where they may be: a single edge beyond either end is no part of the path.
  static int deletions(int path, int edges) { return edges == 1 ? path : path + 3 - edges; }

  int last_addition(int path, int deleted) const {
    return most_ > 0 ? std::min(deleted + ChangeLaw::kMost, most_ - path + deleted) : deleted + ChangeLaw::kMost;
  }

  int most_;
};

// A part of a path: between vertex l and `vertices` more there is vertex m.
struct PathPart {
  int l, m;
  int edges() const { return m - l; }
  int vertices() const { return m - l - 1; }
  // What a path of k edges must have at its ends: x_0, and the lens.
  int least_edges(int k) const { return 1 + (l < 0 ? 1 : 0) + (m > k ? 1 : 0); }
  // Ways to share the vertices among the walks from either end: that from the camera begins with the lens.
  int splits(int k) const { return vertices() + (m > k ? 0 : 1); }
};

// Finds the vertices of the part; those outside of it are there already, and the point of the lens unless it belongs to
// the part.
template <class M>
bool grow(const PathPart& part, PathSpace<M>& space, ChainRandom& random, LightPath<M>& path) {
  const int k = path.edges(), splits = part.splits(k);
  // The last vertex of the walk from the light.
  const int c = part.l + std::min(static_cast<int>(random.next() * static_cast<float>(splits)), splits - 1);
  if (part.l < 0 && c >= 0 && !space.choose_light(random, path)) return false;
  for (int i = std::max(part.l, 0); i < c; ++i)
    if (!(i == 0 ? space.leave_light(random, path) : space.scatter_to_camera(i, random, path))) return false;
  const Vec2 lens = part.m > k ? random.next_2d() : path.lens;
  path.lens = lens;
  for (int i = std::min(part.m, k); i > c + 1; --i)
    if (!(i == k ? space.leave_camera(space.point_of_picture(random.next_2d()), lens, random, path)
                 : space.scatter_to_light(i, random, path)))
      return false;
  if (c >= 0 && !space.connect(c, path)) return false;
  return space.settle(part.l, part.m, path) && (c < 0 || space.visible(c, random, path));
}

// The density of the part over f.
template <class M>
double density_over_f(const PathPart& part, const PathSpace<M>& space, const LightPath<M>& path) {
  const double tried = 1.0 / part.splits(path.edges());
  return path.density_between(part.l, part.m, double{space.picture_area()}, [&](int) { return tried; });
}

// The part of x that goes, and that of y that comes for it.
struct Exchange {
  PathPart deleted, added;
};

// T(x -> y) / f(y).
template <class M>
double tentative(const EdgeCounts& counts, const PathSpace<M>& space, const LightPath<M>& x, const Exchange& e,
                 const LightPath<M>& y) {
  const int k = x.edges(), deleted = e.deleted.edges();
  return EdgeCounts::probability_of_deletion(k, deleted) *
         counts.probability_of_addition(k, deleted, e.deleted.least_edges(k), e.added.edges()) *
         density_over_f(e.added, space, y);
}

// Proposes y from x; nothing if it has no contribution.
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
  y.take_ends(x);
  for (int i = 0; i <= e.deleted.l; ++i) y[i] = x[i];
  for (int i = e.deleted.m; i < k; ++i) y[i - e.deleted.m + e.added.m] = x[i];
  // What is new altogether may be at another time.
  if (e.added.l < 0 && e.added.m > y.edges()) y.time = space.choose_time(random);
  if (!grow(e.added, space, random, y)) return {};
  return e;
}

}  // namespace etendue::integrator
