// The medium state of a path: the solids that contain a point.                              [Schmidt and Budge 2002]
//
// Every solid of a scene has a number, its priority: where solids overlap, the smallest number is the medium. The state
// is a set, sorted by number. The current medium is a function of that set alone, not of the order in which a path
// entered the solids. Camera paths and light paths therefore find the same media, refractive indices and densities at
// the same point, which bidirectional methods rely on.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace etendue::scene {

// Not the number of any solid.
inline constexpr uint32_t kNoSolid = 0xffffffffU;

class MediumStack {
 public:
  // Sixteen nested solids and the one that is entered. One more drops the solid of the lowest priority, which is the
  // medium only after all others have been left.
  static constexpr size_t kCapacity = 17;

  bool empty() const { return size_ == 0; }
  // The number of the current medium; kNoSolid in a vacuum.
  uint32_t top() const { return size_ == 0 ? kNoSolid : solids_[0]; }

  std::span<const uint32_t> solids() const { return {solids_.data(), size_}; }
  bool contains(uint32_t solid) const { return std::ranges::find(solids(), solid) != solids().end(); }

  // Inserting what is present and erasing what is absent do nothing: meshes may be open.
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

  MediumStack around;
  std::array<uint32_t, kMaxBoundaries> boundaries{};
  uint8_t count = 0;
  uint8_t behind = 0;  // bit i: solid boundaries[i] lies on the back of the surface, else on its front
  // How far the boundaries may lie apart by rounding, metres.
  float offset = 0;

  void clear(const MediumStack& stack) {
    around = stack;
    count = 0;
    behind = 0;
    offset = 0;
  }
  // A boundary whose solid lies on the back of the surface, or on its front.
  void add_boundary(uint32_t solid, bool on_back) {
    if (count == kMaxBoundaries) return;
    around.erase(solid);
    behind = static_cast<uint8_t>(behind | (on_back ? 1U : 0U) << count);
    boundaries[count++] = solid;
  }
  // The surface seen from its other side.
  void flip() { behind = static_cast<uint8_t>(~behind); }

  // The solids that contain the points next to one side of the surface.
  MediumStack side(bool front) const {
    MediumStack stack = around;
    for (size_t i = 0; i < count; ++i)
      if (is_on_side(i, front)) stack.insert(boundaries[i]);
    return stack;
  }
  // The medium there.
  uint32_t top(bool front) const {
    uint32_t least = around.top();
    for (size_t i = 0; i < count; ++i)
      if (is_on_side(i, front)) least = std::min(least, boundaries[i]);
    return least;
  }

 private:
  bool is_on_side(size_t i, bool front) const { return ((behind >> i & 1) == 0) == front; }
};

}  // namespace etendue::scene
