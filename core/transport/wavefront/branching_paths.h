// Paths that branch, on a front of walks.                                     thesis 8.2.2, 8.3; (8.24), (8.37)
//
// A front carries one ray of each path. Where a method follows several from a vertex, they wait here, sorted by how
// many edges they are from the camera, and take the front's places once all that it carries has come to its end: those
// farthest from the camera first, as many as there is room for. So no more wait at each distance than one full front
// can send there, however large the trees get. What a branch finds belongs to the path that its tree started with.
//
// Each branch has random numbers of its own (Front::take_twig); the first has the path's, so that a tree without
// branching is a walk, number by number.
#pragma once
#include "transport/wavefront/path_estimators.h"

namespace etendue::transport {

template <class M>
class BranchingPaths {
 public:
  using Color = typename M::Color;

  // One for each thread: what waits needs room, which is kept.
  static BranchingPaths& on(PathWavefront<M>& paths) {
    static thread_local BranchingPaths tree;
    tree.begin(paths);
    return tree;
  }

  // As Front::advance, of all branches; between two of them all arrivals are at the same distance. In the end the front
  // holds the paths that it was launched with, and they have what their trees found.
  bool trace() {
    if (paths_->trace()) return true;
    if (paths_->cancelled()) return false;
    collect();
    if (load_batch()) return paths_->trace();
    finish();
    return false;
  }

  // Every walk goes on in `count` directions, each of which carries an equal share. Where there is more than one, they
  // are of the surface without its deltas: those are followed too, one branch each with all of its weight (Remark 8.5).
  void branch(int count, int roulette_from) {
    if (count == 1) return sample_bsdf(*paths_, roulette_from);
    const bool roulette = paths_->length() >= roulette_from;
    const DimensionSet numbers = roulette ? dimensions(vertex_dimension::kRoulette, 1) : 0;
    const auto lives = [&](PathState<Color>& path, int hit) {
      return !roulette || survives_roulette(path, paths_->random(vertex_dimension::kRoulette, hit));
    };
    for (int stream = 0; stream < count; ++stream) {
      paths_->select_rng_stream(static_cast<uint32_t>(stream));
      paths_->draw_lobes();
      paths_->draw(numbers);
      for (int i = 0; i < paths_->hit_count(); ++i) {
        LobeSample<Color> s;
        if (!paths_->bsdf(i).sample(paths_->wo(i), paths_->lobe_draw(i), TransportMode::radiance, s) || s.delta)
          continue;
        // All of them look for the same light, with so many times the density.
        const auto share = static_cast<float>(count);
        s.weight /= share, s.pdf_solid_angle *= share;
        enqueue(i, s, share, lives);
      }
    }
    follow_deltas(static_cast<uint32_t>(count), numbers, lives);
  }

  // Every walk goes on along each delta of its surface if `keep` says so of what it then carries; of the vertices'
  // random numbers `keep` needs these. The branches are twigs from `first_twig` on.
  template <class Keep>
  void follow_deltas(uint32_t first_twig, DimensionSet numbers, Keep&& keep) {
    if constexpr (M::kDiffuse) return;
    int most = 0;
    for (int i = 0; i < paths_->hit_count(); ++i) {
      DeltaSet<Color>& deltas = deltas_[static_cast<size_t>(i)];
      deltas = paths_->bsdf(i).deltas(paths_->wo(i));
      most = std::max(most, deltas.count);
    }
    for (int k = 0; k < most; ++k) {
      paths_->select_rng_stream(first_twig + static_cast<uint32_t>(k));
      paths_->draw(numbers);
      for (int i = 0; i < paths_->hit_count(); ++i) {
        const DeltaSet<Color>& deltas = deltas_[static_cast<size_t>(i)];
        if (k < deltas.count) enqueue(i, deltas.lobes[static_cast<size_t>(k)], 1, keep);
      }
    }
  }

 private:
  using Shares = ClassShares<M>;
  struct Branch {
    PathState<Color> path;
    Ray ray;
    uint16_t root;
    [[no_unique_address]] MediumState<M> medium;
    [[no_unique_address]] typename Shares::Kept kept;
  };
  // What left vertices of one distance. Shares of path classes are kept apart, as they differ in number.
  struct Level {
    std::vector<Branch> branches;
    std::vector<Color> shares;
  };

  void begin(PathWavefront<M>& paths) {
    paths_ = &paths, roots_ = paths.size();
    for (Level& level : levels_) level.branches.clear(), level.shares.clear();
    for (int i = 0; i < roots_; ++i) found_[static_cast<size_t>(i)] = Color(0), root_[static_cast<size_t>(i)] = id(i);
  }

  static uint16_t id(int path) { return static_cast<uint16_t>(path); }

  // A branch from an arrival. `share`: of so many alike this is one.
  template <class Keep>
  void enqueue(int hit, const LobeSample<Color>& s, float share, Keep&& keep) {
    const int from = paths_->path_at(hit);
    PathState<Color> path = paths_->state(from);
    path.throughput *= s.weight;
    path.eta_scale *= sqr(s.eta) * share;
    if (!keep(path, hit)) return;
    path.radiance = Color(0);
    path.seed = paths_->seed(hit);
    leave(path, paths_->point(hit).position, s);
    if constexpr (M::kClasses) {
      paths_->shares().copy_to_branch(from);
      if (!paths_->shares().scatter(Shares::kBranch, paths_->bsdf(hit), paths_->wo(hit), s)) return;
    }
    Level& level = level_at(paths_->length());
    level.branches.push_back(
        {path, paths_->ray_from(hit, s.wi), root_[static_cast<size_t>(from)], paths_->medium_beyond(hit, s.wi), {}});
    if constexpr (M::kClasses) level.branches.back().kept = paths_->shares().keep_branch(level.shares);
  }

  Level& level_at(int length) {
    const auto at = static_cast<size_t>(length);
    if (levels_.size() <= at) levels_.resize(at + 1);
    return levels_[at];
  }

  void collect() {
    for (int i = 0; i < paths_->size(); ++i) found_[root_[static_cast<size_t>(i)]] += paths_->state(i).radiance;
  }

  // Fills the front with what waits farthest from the camera; false if nothing does.
  bool load_batch() {
    size_t length = levels_.size();
    while (length > 0 && levels_[length - 1].branches.empty()) --length;
    if (length == 0) return false;
    Level& level = levels_[--length];
    paths_->begin_batch(static_cast<int>(length));
    for (size_t n = std::min(level.branches.size(), root_.size()); n > 0; --n) {
      const Branch& branch = level.branches.back();
      const int path = paths_->add_resumed(branch.path, branch.ray, branch.medium);
      if constexpr (M::kClasses) paths_->shares().give_back(branch.kept, level.shares, path);
      root_[static_cast<size_t>(path)] = branch.root;
      level.branches.pop_back();
    }
    return true;
  }

  void finish() {
    paths_->begin_batch(0);
    for (int i = 0; i < roots_; ++i) {
      paths_->add(0);
      paths_->state(i).radiance = found_[static_cast<size_t>(i)];
    }
  }

  PathWavefront<M>* paths_ = nullptr;
  int roots_ = 0;
  std::array<uint16_t, PathWavefront<M>::kCapacity> root_;  // of each path in the front
  std::array<Color, PathWavefront<M>::kCapacity> found_;    // by each root
  std::vector<Level> levels_;
  std::array<DeltaSet<Color>, PathWavefront<M>::kHitsAtATime> deltas_;
};

}  // namespace etendue::transport
