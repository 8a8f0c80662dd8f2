// The medium state of a path: the solids that contain a point.                              [Schmidt and Budge 2002]
//
// The number of a solid is its priority: where solids overlap, the smallest number is the medium. The state is a set,
// sorted by number. The current medium depends on that set alone, not on the order in which a path entered the solids.
// Camera paths and light paths therefore find the same media, refractive indices and densities at the same point, which
// bidirectional integrators require.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace etendue::scene {

// The number of no solid: a vacuum.
inline constexpr uint32_t kNoSolid = 0xffffffffU;

class MediumStack {
 public:
  // Sixteen nested solids and the one being entered. A further solid drops the one of the lowest priority, which
  // becomes the medium only after all others have been left.
  static constexpr size_t kCapacity = 17;

  bool empty() const { return size_ == 0; }
  // The number of the current medium; kNoSolid in a vacuum.
  uint32_t top() const { return size_ == 0 ? kNoSolid : solids_[0]; }

  std::span<const uint32_t> solids() const { return {solids_.data(), size_}; }
  bool contains(uint32_t solid) const { return std::ranges::find(solids(), solid) != solids().end(); }

  // Inserting a member and erasing a solid that is not a member have no effect, since meshes may be open.
  void insert(uint32_t solid) {
    size_t at = 0;
    while (at < size_ && solids_[at] < solid) ++at;
    if (at == kCapacity || (at < size_ && solids_[at] == solid)) return;
    size_ = std::min<uint32_t>(size_ + 1, kCapacity);
    for (size_t i = size_ - 1; i > at; --i) solids_[i] = solids_[i - 1];
    solids_[at] = solid;
  }
  void erase(uint32_t solid) {
    const auto end = solids_.begin() + size_, at = std::find(solids_.begin(), end, solid);
    if (at == end) return;
    std::copy(at + 1, end, at);
    --size_;
  }

  friend bool operator==(const MediumStack& a, const MediumStack& b) {
    return std::ranges::equal(a.solids(), b.solids());
  }

 private:
  uint32_t size_ = 0;
  std::array<uint32_t, kCapacity> solids_{};
};

// The solids on both sides of a surface: those that contain both sides, and those whose boundaries lie in the surface.
struct MediumInterface {
  static constexpr size_t kMaxBoundaries = 4;

  MediumStack surrounding;
  std::array<uint32_t, kMaxBoundaries> boundaries{};
  uint8_t count = 0;
  uint8_t back_mask = 0;  // bit i is set if solid boundaries[i] lies on the back of the surface, else on its front
  // Bound of the distance between the boundaries due to rounding, metres.
  float offset = 0;

  void clear(const MediumStack& stack) {
    surrounding = stack;
    count = 0;
    back_mask = 0;
    offset = 0;
  }
  // Adds the boundary of a solid that lies on the back of the surface, or on its front. Boundaries beyond
  // kMaxBoundaries are ignored.
  void add_boundary(uint32_t solid, bool on_back) {
    if (count == kMaxBoundaries) return;
    surrounding.erase(solid);
    back_mask = static_cast<uint8_t>(back_mask | (on_back ? 1U : 0U) << count);
    boundaries[count++] = solid;
  }
  // Exchanges front and back.
  void flip() { back_mask = static_cast<uint8_t>(~back_mask); }

  // The solids that contain the points next to one side of the surface.
  MediumStack side(bool front) const {
    MediumStack stack = surrounding;
    for (size_t i = 0; i < count; ++i)
      if (is_on_side(i, front)) stack.insert(boundaries[i]);
    return stack;
  }
  // The medium on one side of the surface.
  uint32_t top(bool front) const {
    uint32_t least = surrounding.top();
    for (size_t i = 0; i < count; ++i)
      if (is_on_side(i, front)) least = std::min(least, boundaries[i]);
    return least;
  }

 private:
  bool is_on_side(size_t i, bool front) const { return ((back_mask >> i & 1) == 0) == front; }
};

}  // namespace etendue::scene
