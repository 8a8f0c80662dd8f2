// A tree of bounding boxes with sixteen children per node, which are tested at once.
//
// Its parts are in the order of a space-filling curve. Node i of a level has the children 16 i to 16 i + 15 of the level
// below, so there are no pointers.
#pragma once
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <vector>

#include "base/vectorize.h"
#include "geometry/mesh.h"

namespace etendue::photon {

// The boxes of the children of a node.
struct BoxBlock {
  static constexpr size_t kSize = 16;
  using Distances = std::array<float, kSize>;

  BoxBlock();  // of empty boxes
  void set(size_t i, const Bounds& box);
  Bounds bounds() const;

  Bounds operator[](size_t i) const { return {{min_x[i], min_y[i], min_z[i]}, {max_x[i], max_y[i], max_z[i]}}; }

  // The squared distances to a region. They are at most those of the points in the boxes, also after rounding.
  void find_distances(const Bounds& region, Distances& distances2) const {
    const auto gap = [](float below, float above) { return std::max(std::max(below, above), 0.0f); };
#pragma GCC ivdep
    for (size_t i = 0; i < kSize; ++i)
      distances2[i] = sqr(gap(min_x[i] - region.max.x, region.min.x - max_x[i])) +
                      sqr(gap(min_y[i] - region.max.y, region.min.y - max_y[i])) +
                      sqr(gap(min_z[i] - region.max.z, region.min.z - max_z[i]));
  }

  alignas(64) std::array<float, kSize> min_x, min_y, min_z, max_x, max_y, max_z;
};

// One bit for each of sixteen values that is below a limit. With vector types, because the compiler unrolls such loops
// before it would vectorise them.
inline uint32_t bits_below(const std::array<float, 16>& values, float limit) {
  using Floats [[gnu::vector_size(64)]] = float;
  using Integers [[gnu::vector_size(64)]] = int32_t;
  Floats v;
  std::memcpy(&v, values.data(), sizeof v);
  constexpr Integers kBits{1,      1 << 1, 1 << 2,  1 << 3,  1 << 4,  1 << 5,  1 << 6,  1 << 7,
                           1 << 8, 1 << 9, 1 << 10, 1 << 11, 1 << 12, 1 << 13, 1 << 14, 1 << 15};
  Integers bits = (v < limit) & kBits;
  bits |= __builtin_shufflevector(bits, bits, 8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7);
  bits |= __builtin_shufflevector(bits, bits, 4, 5, 6, 7, 0, 1, 2, 3, 12, 13, 14, 15, 8, 9, 10, 11);
  bits |= __builtin_shufflevector(bits, bits, 2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13);
  return static_cast<uint32_t>(bits[0] | bits[1]);
}

class BoxTree {
 public:
  // `boxes` of the parts.
  void build(std::span<const Bounds> boxes);
  size_t memory() const { return blocks_.capacity() * sizeof(BoxBlock); }

  Bounds box(uint32_t part) const { return blocks_[part / BoxBlock::kSize][part % BoxBlock::kSize]; }
  // A part whose box is close to a point; the tree must not be empty.
  uint32_t find_close(const Vec3& position) const;
  // Calls visit(part) for the parts whose boxes are nearer to a region than the root of `distance2`.
  template <class Visit>
  void visit_within(const Bounds& region, float distance2, const Visit& visit) const;
  // Calls visit(part) for the parts whose boxes overlap a ball, nearer ones first; it returns the squared radius of the
  // ball from there on.
  template <class Visit>
  void visit_nearest(const Vec3& center, float radius2, const Visit& visit) const;

 private:
  static constexpr size_t kMaxLevels = 8;

  const BoxBlock& block(uint32_t level, uint32_t number) const { return blocks_[level_[level] + number]; }

  std::vector<BoxBlock> blocks_;            // level by level, the lowest first
  std::array<size_t, kMaxLevels> level_{};  // the first block of each level
  uint32_t levels_ = 0;
};

inline uint32_t BoxTree::find_close(const Vec3& position) const {
  uint32_t number = 0;
  for (uint32_t level = levels_; level-- > 0;) {
    BoxBlock::Distances distances2;
    block(level, number).find_distances({position, position}, distances2);
    uint32_t nearest = 0;
    for (uint32_t i = 1; i < BoxBlock::kSize; ++i) nearest = distances2[i] < distances2[nearest] ? i : nearest;
    number = number * BoxBlock::kSize + nearest;
  }
  return number;
}

template <class Visit>
void BoxTree::visit_within(const Bounds& region, float distance2, const Visit& visit) const {
  struct Pending {
    uint32_t level, number;  // of a block
  };
  std::array<Pending, kMaxLevels * BoxBlock::kSize> pending;
  size_t count = 0;
  if (levels_ > 0) pending[count++] = {levels_ - 1, 0};
  while (count > 0) {
    const Pending here = pending[--count];
    BoxBlock::Distances distances2;
    block(here.level, here.number).find_distances(region, distances2);
    for (uint32_t bits = bits_below(distances2, distance2); bits != 0; bits &= bits - 1) {
      const uint32_t child = here.number * BoxBlock::kSize + static_cast<uint32_t>(std::countr_zero(bits));
      if (here.level == 0)
        visit(child);
      else
        pending[count++] = {here.level - 1, child};
    }
  }
}

template <class Visit>
void BoxTree::visit_nearest(const Vec3& center, float radius2, const Visit& visit) const {
  struct Pending {
    float distance2;
    uint32_t level;  // 0: a part
    uint32_t number;
  };
  std::array<Pending, kMaxLevels * BoxBlock::kSize> pending;
  size_t count = 0;
  if (levels_ > 0) pending[count++] = {0, levels_, 0};
  while (count > 0) {
    const Pending here = pending[--count];
    if (!(here.distance2 < radius2)) continue;
    if (here.level == 0) {
      radius2 = visit(here.number);
      continue;
    }
    BoxBlock::Distances distances2;
    block(here.level - 1, here.number).find_distances({center, center}, distances2);
    const size_t first = count;
    for (uint32_t bits = bits_below(distances2, radius2); bits != 0; bits &= bits - 1) {
      const auto i = static_cast<uint32_t>(std::countr_zero(bits));
      size_t at = count++;
      for (; at > first && pending[at - 1].distance2 < distances2[i]; --at) pending[at] = pending[at - 1];
      pending[at] = {distances2[i], here.level - 1, static_cast<uint32_t>(here.number * BoxBlock::kSize + i)};
    }
  }
}

}  // namespace etendue::photon
