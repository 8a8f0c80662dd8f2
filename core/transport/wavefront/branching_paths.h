// Branching paths on a wavefront.                                               [Lang, sec. 8.3, 8.4; eq. 8.24, 8.37]
//
// A wavefront has one ray per path. Further branches from a vertex are queued here by their number of edges from the
// camera, and processed in batches once all paths of the wavefront have ended: the deepest first, as many as the
// wavefront can hold. So the queue of each depth is bounded by the branches of one full wavefront, for trees of any
// size. The radiance of a branch is added to the path at the root of its tree.
//
// Each branch has its own random numbers (PathWavefront::select_rng_stream). The first branch uses those of the path,
// so that without branching the samples are identical to those of a single path.
#pragma once
#include <algorithm>

#include "transport/wavefront/path_estimators.h"

namespace etendue::transport {

template <class M>
class BranchingPaths {
 public:
  using Color = typename M::Color;

  // The object of this thread, reused for its memory.
  static BranchingPaths& on(PathWavefront<M>& paths) {
    static thread_local BranchingPaths tree;
    tree.begin(paths);
    return tree;
  }

  // As PathWavefront::trace, for all branches; all current hits have the same depth. At the end, the wavefront holds
  // the paths that it was launched with, with the radiance of their trees.
  bool trace() {
    if (paths_->trace()) return true;
    if (paths_->cancelled()) return false;
    collect();
    if (load_batch()) return paths_->trace();
    finish();
    return false;
  }

  // Continues every path in `count` directions with equal shares. If there are several, they are sampled from the
  // non-specular lobes; in addition, one branch follows each specular direction with its full weight [Lang, Remark
  // 8.5].
  void branch(int count, const RouletteSettings& roulette) {
    if (count == 1) return sample_bsdf(*paths_, roulette);
    branch_where(count, static_cast<float>(count), roulette, EveryHit());
  }

  // The same at the first vertices that are not specular, which is splitting [Lang, sec. 8.4]; other vertices continue in
  // one direction. The weights of multiple importance sampling are those of one BSDF sample.
  void split_first_rough(int count, const RouletteSettings& roulette) {
    const auto splits = [this](int hit) {
      return paths_->state_at(hit).all_specular && paths_->bsdf(hit).has_non_delta_lobe();
    };
    std::array<bool, PathWavefront<M>::kHitsAtATime> selected;
    for (int i = 0; i < paths_->hit_count(); ++i) selected[static_cast<size_t>(i)] = count > 1 && splits(i);
    sample_bsdf_where(
        *paths_, roulette, TransportMode::radiance, [&](int hit) { return !selected[static_cast<size_t>(hit)]; },
        [](int, const auto&) {});
    if (std::find(selected.begin(), selected.begin() + paths_->hit_count(), true) !=
        selected.begin() + paths_->hit_count())
      branch_where(count, 1, roulette, [&](int hit) { return selected[static_cast<size_t>(hit)]; });
  }

  // Continues every path along each specular direction for which should_follow(path, hit, sample, 1) holds, which may
  // use the random numbers `numbers`. The branches use random number streams from `first_stream` on.
  template <class Condition, class Selected = EveryHit>
  void follow_deltas(uint32_t first_stream, DimensionSet numbers, Condition&& should_follow,
                     const Selected& selected = {}) {
    if constexpr (M::kDiffuse) return;
    int most = 0;
    for (int i = 0; i < paths_->hit_count(); ++i) {
      DeltaSet<Color>& deltas = deltas_[static_cast<size_t>(i)];
      deltas = {};
      if (selected(i)) deltas = paths_->bsdf(i).deltas(paths_->wo(i));
      most = std::max(most, deltas.count);
    }
    for (int k = 0; k < most; ++k) {
      paths_->select_rng_stream(first_stream + static_cast<uint32_t>(k));
      paths_->draw(numbers);
      for (int i = 0; i < paths_->hit_count(); ++i) {
        const DeltaSet<Color>& deltas = deltas_[static_cast<size_t>(i)];
        if (k < deltas.count) enqueue(i, deltas.lobes[static_cast<size_t>(k)], 1, should_follow);
      }
    }
  }

 private:
  // Branches from the selected hits. `density_factor`: the number of directions that can find the same light, by which
  // their density is multiplied.
  template <class Selected>
  void branch_where(int count, float density_factor, const RouletteSettings& roulette, const Selected& selected) {
    const bool may_end = paths_->length() >= roulette.start;
    const DimensionSet numbers = may_end ? dimensions(vertex_dimension::kRoulette, 1) : 0;
    const auto survives = [&](PathState<Color>& path, int hit, const LobeSample<Color>& s, float share) {
      if (!may_end) return true;
      LobeSample<Color> whole = s;  // without the share of the branch
      whole.weight *= share;
      return survives_roulette(*paths_, roulette, hit, path, whole, paths_->random(vertex_dimension::kRoulette, hit));
    };
    for (int stream = 0; stream < count; ++stream) {
      paths_->select_rng_stream(static_cast<uint32_t>(stream));
      paths_->draw_lobes();
      paths_->draw(numbers);
      for (int i = 0; i < paths_->hit_count(); ++i) {
        if (!selected(i)) continue;
        LobeSample<Color> s;
        if (!paths_->bsdf(i).sample(paths_->wo(i), paths_->lobe_draw(i), TransportMode::radiance, s) || s.delta)
          continue;
        const auto share = static_cast<float>(count);
        s.weight /= share;
        s.pdf_solid_angle *= density_factor;
        enqueue(i, s, share, survives);
      }
    }
    follow_deltas(static_cast<uint32_t>(count), numbers, survives, selected);
  }

  using Shares = ClassShares<M>;
  struct Branch {
    PathState<Color> path;
    Ray ray;
    uint16_t root;
    [[no_unique_address]] MediumState<M> medium;
    [[no_unique_address]] typename Shares::Saved saved;
  };
  // The queue of one depth. Path class shares are stored separately, because their number varies.
  struct Level {
    std::vector<Branch> branches;
    std::vector<Color> shares;
  };

  void begin(PathWavefront<M>& paths) {
    paths_ = &paths;
    roots_ = paths.size();
    for (Level& level : levels_) {
      level.branches.clear();
      level.shares.clear();
    }
    for (int i = 0; i < roots_; ++i) {
      radiance_[static_cast<size_t>(i)] = Color(0);
      root_of_path_[static_cast<size_t>(i)] = id(i);
    }
  }

  static uint16_t id(int path) { return static_cast<uint16_t>(path); }

  // Queues a branch from a hit. `share`: the number of branches that share the throughput equally.
  template <class Condition>
  void enqueue(int hit, const LobeSample<Color>& s, float share, Condition&& should_follow) {
    const int from = paths_->path_at(hit);
    PathState<Color> path = paths_->state(from);
    path.throughput *= s.weight;
    path.eta_scale *= sqr(s.eta) * share;
    if (paths_->recorder()) record_sample(*paths_, hit, s, PathEnd::none);
    if (!should_follow(path, hit, s, share)) {
      if (paths_->recorder()) record_end(*paths_, hit, PathEnd::roulette);
      return;
    }
    path.radiance = Color(0);
    path.seed = paths_->seed(hit);
    record_scattering(path, paths_->point(hit).position, paths_->receiver_normal(hit), s);
    if constexpr (M::kClasses) {
      paths_->shares().copy_to_branch(from);
      if (!paths_->shares().scatter(Shares::kBranch, paths_->bsdf(hit), paths_->wo(hit), s)) {
        if (paths_->recorder()) record_end(*paths_, hit, PathEnd::excluded);
        return;
      }
    }
    if (paths_->recorder()) {
      record_throughput(*paths_, hit, path.throughput);
      paths_->recorder()->queue_branch(from, paths_->length());
    }
    Level& level = level_at(paths_->length());
    level.branches.push_back({path,
                              paths_->ray_from(hit, s.wi),
                              root_of_path_[static_cast<size_t>(from)],
                              paths_->medium_beyond(hit, s.wi),
                              {}});
    if constexpr (M::kClasses) level.branches.back().saved = paths_->shares().save_branch(level.shares);
  }

  Level& level_at(int length) {
    const auto at = static_cast<size_t>(length);
    if (levels_.size() <= at) levels_.resize(at + 1);
    return levels_[at];
  }

  void collect() {
    if (paths_->recorder()) paths_->recorder()->collect(paths_->size());
    for (int i = 0; i < paths_->size(); ++i)
      radiance_[root_of_path_[static_cast<size_t>(i)]] += paths_->state(i).radiance;
  }

  // Loads the deepest queued branches into the wavefront; false if there are none.
  bool load_batch() {
    size_t length = levels_.size();
    while (length > 0 && levels_[length - 1].branches.empty()) --length;
    if (length == 0) return false;
    Level& level = levels_[--length];
    paths_->begin_batch(static_cast<int>(length));
    for (size_t n = std::min(level.branches.size(), root_of_path_.size()); n > 0; --n) {
      const Branch& branch = level.branches.back();
      const int path = paths_->add_resumed(branch.path, branch.ray, branch.medium);
      if constexpr (M::kClasses) paths_->shares().restore_branch(branch.saved, level.shares, path);
      root_of_path_[static_cast<size_t>(path)] = branch.root;
      if (paths_->recorder()) paths_->recorder()->resume_branch(path, static_cast<int>(length), branch.root);
      level.branches.pop_back();
    }
    return true;
  }

  void finish() {
    paths_->begin_batch(0);
    for (int i = 0; i < roots_; ++i) {
      paths_->add(0);
      paths_->state(i).radiance = radiance_[static_cast<size_t>(i)];
    }
  }

  PathWavefront<M>* paths_ = nullptr;
  int roots_ = 0;
  std::array<uint16_t, PathWavefront<M>::kCapacity> root_of_path_;  // root of each path of the wavefront
  std::array<Color, PathWavefront<M>::kCapacity> radiance_;         // by root
  std::vector<Level> levels_;
  std::array<DeltaSet<Color>, PathWavefront<M>::kHitsAtATime> deltas_;
};

}  // namespace etendue::transport
