// Bootstrap samples: independent light paths at which Markov chains start.
//                                                                [Lang, sec. 9.3.2, Remark 9.18; Veach and Guibas 1997]
//
// One subpath from either end, and all paths of a prefix of each, joined by a connection or, if the camera subpath hits
// a light, without one: bidirectional path tracing with the balance heuristic. All of them together are the bootstrap
// sample; one of them, chosen in proportion to its contribution, is the seed of a chain.
#pragma once
#include "integrator/mlt/path_space.h"

namespace etendue::integrator {

// The distribution of the maximum number of vertices of a subpath. Its tail is as heavy as a finite mean allows, so
// that the weight of a path has a finite variance for every albedo.
class SubpathLengths {
 public:
  // `max_edges` 0: no limit.
  explicit SubpathLengths(int max_edges) : max_edges_(max_edges > 0 ? std::min(max_edges, kMaxLength) : kMaxLength) {}

  int choose(ChainRandom& random) const {
    return std::min(static_cast<int>(kScale / std::sqrt(1 - random.next()) - kScale) + 1, max_edges_);
  }
  // The probability that the maximum is at least `vertices`.
  double probability(int vertices) const {
    return vertices < 1 ? 1 : vertices > max_edges_ ? 0 : sqr(kScale / (kScale + static_cast<float>(vertices - 1)));
  }

 private:
  static constexpr float kScale = 3;
  static constexpr int kMaxLength = 256;
  int max_edges_;
};

template <class M>
class BootstrapPaths {
 public:
  // `max_edges` 0: no limit.
  explicit BootstrapPaths(int most_edges) : max_edges_(most_edges), lengths_(most_edges) {}

  // Draws a bootstrap sample. Returns its weight f / p, summed over all its paths, zero if there are none; `selected`
  // is one of them.
  double draw(PathSpace<M>& space, ChainRandom& random, LightPath<M>& selected) {
    from_camera_.time = from_light_.time = path_.time = space.choose_time(random);
    sample_camera_subpath(lengths_.choose(random), space, random);
    sample_light_subpath(lengths_.choose(random), space, random);
    double weight = 0;
    const int max_length =
        max_edges_ > 0 ? std::min(max_edges_, camera_count_ + light_count_ + 1) : camera_count_ + light_count_ + 1;
    for (int k = 1; k <= max_length; ++k)
      for (int c = -1; c < std::min(k, light_count_); ++c) {
        if (!assemble(k, c, space, random)) continue;
        const double w = 1 / density_over_f(space);
        weight += w;
        if (double{random.next()} * weight < w) selected = path_;
      }
    return weight;
  }

 private:
  // Samples the vertices of from_camera_ from the last one down. An infinite light is one more vertex, at the end.
  void sample_camera_subpath(int vertices, PathSpace<M>& space, ChainRandom& random) {
    LightPath<M>& subpath = from_camera_;
    subpath.resize(vertices);
    const Vec2 raster = space.image_point(random.next_2d()), lens = random.next_2d();
    int i = vertices;
    subpath[i - 1].length = 0;
    bool has_hit = space.trace_from_camera(raster, lens, random, subpath);
    while (has_hit && --i > 0) {
      subpath[i - 1].length = 0;
      has_hit = space.scatter_to_light(i, random, subpath);
    }
    const int last = std::max(i - 1, 0);
    reaches_environment_ = std::isinf(subpath[last].length);
    camera_count_ = vertices - last - (has_hit && !reaches_environment_ ? 0 : 1);
  }
  void sample_light_subpath(int vertices, PathSpace<M>& space, ChainRandom& random) {
    LightPath<M>& subpath = from_light_;
    subpath.resize(vertices);
    light_count_ = space.sample_light(random, subpath) ? 1 : 0;
    const auto step = [&](int i) {
      return i == 0 ? space.trace_from_light(random, subpath) : space.scatter_to_camera(i, random, subpath);
    };
    while (light_count_ > 0 && light_count_ < vertices && step(light_count_ - 1)) ++light_count_;
  }

  // Assembles the path of k edges whose connection is edge c; false if it does not exist or has no contribution.
  bool assemble(int k, int c, PathSpace<M>& space, ChainRandom& random) {
    if (k - 1 - c > camera_count_ + (c < 0 && reaches_environment_ ? 1 : 0)) return false;
    path_.resize(k);
    path_.raster = from_camera_.raster;
    path_.lens = from_camera_.lens;
    const int shift = from_camera_.edges() - k;
    for (int i = c + 1; i < k; ++i) path_[i] = from_camera_[shift + i];
    if (c < 0) return space.end_on_light(path_) && space.evaluate(-1, k + 1, path_);
    path_.light = from_light_.light;
    for (int i = 0; i <= c; ++i) path_[i] = from_light_[i];
    return space.connect(c, path_) && space.evaluate(-1, k + 1, path_) && space.visible(c, random, path_);
  }

  double density_over_f(const PathSpace<M>& space) const {
    const int k = path_.edges();
    return path_.density_between(-1, k + 1, double{space.image_area()},
                                 [&](int c) { return lengths_.probability(c + 1) * lengths_.probability(k - 1 - c); });
  }

  int max_edges_;
  SubpathLengths lengths_;
  LightPath<M> from_camera_, from_light_, path_;
  int camera_count_ = 0, light_count_ = 0;  // vertices of either subpath
  bool reaches_environment_ = false;        // the camera subpath leaves the scene
};

}  // namespace etendue::integrator
