// A point that lights illuminate, with the normal of its surface if the surface reflects light on one side only.
#pragma once
#include <cstdint>

#include "base/vec.h"

namespace etendue {

// A direction with ten bits per coordinate, or none. The density of a light sample must follow from the same normal
// as the choice of the light, also at the next vertex of the path, which stores it in this form.
class PackedNormal {
 public:
  constexpr PackedNormal() = default;  // none
  explicit PackedNormal(const Vec3& n) : bits_(1U << 30 | bits(n.x) | bits(n.y) << 10 | bits(n.z) << 20) {}

  explicit operator bool() const { return bits_ != 0; }
  // Nearly a unit vector; zero if there is none.
  Vec3 unpacked() const {
    if (bits_ == 0) return Vec3(0);
    return Vec3(coordinate(bits_), coordinate(bits_ >> 10), coordinate(bits_ >> 20));
  }

 private:
  static constexpr float kScale = 511;
  static uint32_t bits(float v) { return static_cast<uint32_t>(v * kScale + (kScale + 0.5f)); }
  static float coordinate(uint32_t bits) {
    return (static_cast<float>(static_cast<int>(bits & 1023)) - kScale) * (1 / kScale);
  }

  uint32_t bits_ = 0;
};

struct LightReceiver {
  Vec3 position{0};
  PackedNormal normal;  // on the lit side; none in a medium and on surfaces that transmit light

  LightReceiver(const Vec3& p, PackedNormal n = {}) : position(p), normal(n) {}  // NOLINT: a position alone
};

}  // namespace etendue
