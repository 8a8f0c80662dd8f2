// Light paths from nothing: where chains over whole paths start.                     thesis 9.3.2, Remark 9.18; S18,
// S24
//
// One walk from either end, and all paths that a part of each makes, joined by a connection or, where the walk from the
// camera meets a light, without one: bidirectional path tracing with the balance heuristic. All paths together are the
// candidate, and one of them, chosen in proportion to what it is worth, is where a chain would start.
#pragma once
#include "integrator/mlt/path_space.h"

namespace etendue::integrator {

// How many vertices a walk has at most. Long walks become rare as slowly as their mean allows, so that what a path is
// worth has a variance in a room of any albedo.
class WalkLengths {
 public:
  // 0 is no limit.
  explicit WalkLengths(int most) : most_(most > 0 ? std::min(most, kLongest) : kLongest) {}

  int choose(ChainRandom& random) const {
    return std::min(static_cast<int>(kSlow / std::sqrt(1 - random.next()) - kSlow) + 1, most_);
  }
  // That a walk may have so many, or more.
  double probability(int vertices) const {
    return vertices < 1 ? 1 : vertices > most_ ? 0 : sqr(kSlow / (kSlow + static_cast<float>(vertices - 1)));
  }

 private:
  static constexpr float kSlow = 3;
  static constexpr int kLongest = 256;
  int most_;
};

template <class M>
class PathCandidates {
 public:
  // Of no more than so many edges; 0 is no limit.
  explicit PathCandidates(int most_edges) : most_(most_edges), lengths_(most_edges) {}

  // What all paths of a candidate are worth together, f / p; zero if none. Then `chosen` is one of them.
  double draw(PathSpace<M>& space, ChainRandom& random, LightPath<M>& chosen) {
    from_camera_.time = from_light_.time = path_.time = space.choose_time(random);
    walk_from_camera(lengths_.choose(random), space, random);
    walk_from_light(lengths_.choose(random), space, random);
    double weight = 0;
    const int longest = most_ > 0 ? std::min(most_, seen_ + lit_ + 1) : seen_ + lit_ + 1;
    for (int k = 1; k <= longest; ++k)
      for (int c = -1; c < std::min(k, lit_); ++c) {
        if (!assemble(k, c, space, random)) continue;
        const double w = 1 / density_over_f(space);
        weight += w;
        if (double{random.next()} * weight < w) chosen = path_;
      }
    return weight;
  }

 private:
  // Finds vertices of from_camera_ from the last one down. The light of infinity is one more, at the end.
  void walk_from_camera(int vertices, PathSpace<M>& space, ChainRandom& random) {
    LightPath<M>& walk = from_camera_;
    walk.resize(vertices);
    const Vec2 raster = space.point_of_picture(random.next_2d()), lens = random.next_2d();
    int i = vertices;
    walk[i - 1].length = 0;
    bool found = space.leave_camera(raster, lens, random, walk);
    while (found && --i > 0) {
      walk[i - 1].length = 0;
      found = space.scatter_to_light(i, random, walk);
    }
    const int last = std::max(i - 1, 0);
    miss_count_ = std::isinf(walk[last].length);
    seen_ = vertices - last - (found && !miss_count_ ? 0 : 1);
  }
  void walk_from_light(int vertices, PathSpace<M>& space, ChainRandom& random) {
    LightPath<M>& walk = from_light_;
    walk.resize(vertices);
    lit_ = space.choose_light(random, walk) ? 1 : 0;
    const auto step = [&](int i) {
      return i == 0 ? space.leave_light(random, walk) : space.scatter_to_camera(i, random, walk);
    };
    while (lit_ > 0 && lit_ < vertices && step(lit_ - 1)) ++lit_;
  }

  // The path of k edges whose connection is edge c; false if there is none, or it has no contribution.
  bool assemble(int k, int c, PathSpace<M>& space, ChainRandom& random) {
    if (k - 1 - c > seen_ + (c < 0 && miss_count_ ? 1 : 0)) return false;
    path_.resize(k);
    path_.raster = from_camera_.raster;
    path_.lens = from_camera_.lens;
    const int shift = from_camera_.edges() - k;
    for (int i = c + 1; i < k; ++i) path_[i] = from_camera_[shift + i];
    if (c < 0) return space.meet_light(path_) && space.settle(-1, k + 1, path_);
    path_.light = from_light_.light;
    for (int i = 0; i <= c; ++i) path_[i] = from_light_[i];
    return space.connect(c, path_) && space.settle(-1, k + 1, path_) && space.visible(c, random, path_);
  }

  double density_over_f(const PathSpace<M>& space) const {
    const int k = path_.edges();
    return path_.density_between(-1, k + 1, double{space.picture_area()},
                                 [&](int c) { return lengths_.probability(c + 1) * lengths_.probability(k - 1 - c); });
  }

  int most_;
  WalkLengths lengths_;
  LightPath<M> from_camera_, from_light_, path_;
  int seen_ = 0, lit_ = 0;   // vertices of either
  bool miss_count_ = false;  // the walk from the camera
};

}  // namespace etendue::integrator
