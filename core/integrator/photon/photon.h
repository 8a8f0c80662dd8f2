// What is stored of a photon.                                        thesis 9.5, L17942-17979; digest 8-10: S32, O25
//
// 32 bytes: position and power in full, the normal of the surface in 30 bits beside the axis of the tree, the direction
// in 20 bits beside the length of its path and what classes of paths ask for.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/vec.h"
#include "base/vectorize.h"
#include "spectrum/rgb.h"

namespace etendue::photon {

// A unit vector in 2 x bits: the octahedron around it, unfolded (Cigolle et al. 2014). Off by at most 4.3 / 2^bits.
constexpr uint32_t grid_of(float x, int bits) {
  const auto most = static_cast<float>((1 << bits) - 1);
  return static_cast<uint32_t>(static_cast<int32_t>((std::clamp(x, -1.0f, 1.0f) * 0.5f + 0.5f) * most + 0.5f));
}

// Without branches, which directions would make unpredictable.
inline uint32_t packed_direction(const Vec3& v, int bits) {
  const float size = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
  const float x = v.x / size, y = v.y / size;
  const float folded_x = (1 - std::abs(y)) * select(x < 0, -1.0f, 1.0f);
  const float folded_y = (1 - std::abs(x)) * select(y < 0, -1.0f, 1.0f);
  return grid_of(select(v.z < 0, folded_x, x), bits) << bits | grid_of(select(v.z < 0, folded_y, y), bits);
}
// The same for many; arrays have room for whole registers.
void packed_directions(const Vec3LanesView& v, size_t count, int bits, uint32_t* packed);

// Not of unit length.
inline Vec3 unfolded_direction(uint32_t packed, int bits) {
  const uint32_t mask = (1U << bits) - 1;
  const float scale = 2 / static_cast<float>(mask);
  Vec3 v(static_cast<float>(packed >> bits & mask) * scale - 1, static_cast<float>(packed & mask) * scale - 1, 0);
  v.z = 1 - std::abs(v.x) - std::abs(v.y);
  const float fold = std::max(-v.z, 0.0f);
  v.x += v.x < 0 ? fold : -fold, v.y += v.y < 0 ? fold : -fold;
  return v;
}
inline Vec3 unpacked_direction(uint32_t packed, int bits) { return glm::normalize(unfolded_direction(packed, bits)); }

class Photon {
 public:
  static constexpr int kNormalBits = 15, kDirectionBits = 10;
  // Longer paths count as this long.
  static constexpr int kLongest = 63;

  Photon() = default;
  // `direction` points back to where it came from; `length` is the number of edges of its path; `state` is below 64.
  Photon(const Vec3& position, const Vec3& direction, const Vec3& normal, const Rgb& power, int length,
         uint8_t state = 0)
      : Photon(position, packed_direction(direction, kDirectionBits), packed_direction(normal, kNormalBits), power,
               length, state) {}
  // The same of a direction and a normal that are packed already.
  Photon(const Vec3& position, uint32_t direction, uint32_t normal, const Rgb& power, int length, uint8_t state)
      : position_(position),
        normal_(normal << 2),
        power_(power),
        rest_(direction << 12 | static_cast<uint32_t>(std::min(length, kLongest)) << 6 | state) {}

  const Vec3& position() const { return position_; }
  const Rgb& power() const { return power_; }  // watts
  Vec3 normal() const { return unpacked_direction(normal_ >> 2, kNormalBits); }
  // Whether its surface faces about as a unit normal does: they are less than 60 degrees apart.
  bool faces(const Vec3& other) const {
    const Vec3 n = unfolded_direction(normal_ >> 2, kNormalBits);
    const float cosine = glm::dot(n, other);
    return cosine > 0 && sqr(cosine) > 0.25f * glm::dot(n, n);
  }
  Vec3 direction() const { return unpacked_direction(rest_ >> 12, kDirectionBits); }
  int length() const { return static_cast<int>(rest_ >> 6 & 63); }
  uint8_t state() const { return rest_ & 63; }

  // Of the tree's plane through it.
  int axis() const { return static_cast<int>(normal_ & 3); }
  void set_axis(int axis) { normal_ = (normal_ & ~3U) | static_cast<uint32_t>(axis); }

 private:
  Vec3 position_{0};
  uint32_t normal_ = 0;
  Rgb power_{0};
  uint32_t rest_ = 0;
};

static_assert(sizeof(Photon) == 32);

}  // namespace etendue::photon
