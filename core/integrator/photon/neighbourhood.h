// The photons nearest to a point, selected by counting: the photons within a trial radius are counted by vector
// instructions, and the radius is interpolated until the number fits. Sorting and partitioning would mispredict every
// other branch.
#pragma once
#include <bit>
#include <span>
#include <vector>

#include "integrator/photon/box_tree.h"
#include "integrator/photon/photon_block.h"

namespace etendue::photon {

class Neighbourhood {
 public:
  // Starts with a disc or ball without photons.
  void begin(float radius2);
  // Adds the photons of a leaf that lie within the radius. Those that do not count have an infinite distance.
  void add(uint32_t leaf, const BlockDistances& distances2) {
    const uint32_t bits = bits_below(distances2, radius2_);
    if (bits == 0) return;
    if (leaf_count_ == leaves_.size()) grow();
    leaves_[leaf_count_] = leaf;
    distances2_[leaf_count_++].values = distances2;
    size_ += static_cast<size_t>(std::popcount(bits));
  }
  // Keeps the nearest photons: at least `least`, and at most `most`. There must be so many.
  void keep_nearest(size_t least, size_t most);
  // Keeps the nearest `count` photons, but for the farthest of them, at which the region ends: including it would
  // overestimate the density by N / (N - 1). If there are fewer photons, the region has its maximum radius, or ends at
  // the farthest if that is infinite.
  void end(size_t count);

  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  float radius2() const { return radius2_; }

  // Whether all photons are nearer than the radius. Otherwise several have the same distance as the farthest, and some
  // of these are at the radius.
  bool is_open() const { return on_border_ == 0; }
  // The leaves with photons, and their squared distances.
  std::span<const uint32_t> leaves() const { return {leaves_.data(), leaf_count_}; }
  const BlockDistances& distances2(size_t leaf_index) const { return distances2_[leaf_index].values; }
  // Calls visit(leaf, i, distance2) for each photon.
  template <class Visit>
  void for_each(Visit&& visit) const;

 private:
  static constexpr size_t kSpareLeaves = 64;

  struct alignas(64) LeafDistances {
    BlockDistances values;
  };

  void grow();
  size_t count_within(float radius2) const;
  float farthest_within(float radius2) const;
  // Shrinks the region until it has between `least` and `most` photons, if a number of trials suffices.
  void shrink(size_t least, size_t most);
  void keep_exactly(size_t count);
  void remove_leaves_outside();

  std::vector<uint32_t> leaves_;  // buffers
  std::vector<LeafDistances> distances2_;
  size_t leaf_count_ = 0;
  size_t max_leaves_ = 0;  // until those without photons are removed
  float radius2_ = 0;
  size_t size_ = 0;       // photons within the radius
  size_t on_border_ = 0;  // of those at the radius
};

template <class Visit>
void Neighbourhood::for_each(Visit&& visit) const {
  size_t on_border = 0;
  for (size_t k = 0; k < leaf_count_; ++k)
    for (size_t i = 0; i < PhotonBlock::kSize; ++i) {
      const float distance2 = distances2(k)[i];
      if (distance2 < radius2_ || (distance2 == radius2_ && on_border++ < on_border_)) visit(leaves_[k], i, distance2);
    }
}

}  // namespace etendue::photon
