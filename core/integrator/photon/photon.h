// A stored photon in 32 bytes.                                                    [Lang, sec. 9.5; Cigolle et al. 2014]
//
// Position and power have full precision. The normal has 30 bits; the direction has 20 bits, beside the length of its
// path and the state of its path class.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/vec.h"
#include "base/vectorize.h"
#include "spectrum/rgb.h"

namespace etendue::photon {

// Quantises a unit vector to 2 x bits by the octahedral map [Cigolle et al. 2014]. The error is at most 4.3 / 2^bits.
// Not a number, as in the padding of arrays, counts as -1.
constexpr uint32_t quantize(float x, int bits) {
  const auto most = static_cast<float>((1 << bits) - 1);
  const float bounded = std::max(-1.0f, std::min(x, 1.0f));
  return static_cast<uint32_t>(static_cast<int32_t>((bounded * 0.5f + 0.5f) * most + 0.5f));
}

// Branch-free, because the branches would be unpredictable.
inline uint32_t pack_direction(const Vec3& v, int bits) {
  const float size = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
  const float x = v.x / size, y = v.y / size;
  const float folded_x = (1 - std::abs(y)) * select(x < 0, -1.0f, 1.0f);
  const float folded_y = (1 - std::abs(x)) * select(y < 0, -1.0f, 1.0f);
  return quantize(select(v.z < 0, folded_x, x), bits) << bits | quantize(select(v.z < 0, folded_y, y), bits);
}
// Packs many directions; arrays are padded to whole registers.
void pack_directions(const Vec3LanesView& v, size_t count, int bits, uint32_t* packed);

// Not normalised. Signed integers, because vector instructions convert only those.
inline Vec3 unfold_direction(uint32_t packed, int bits) {
  const uint32_t mask = (1U << bits) - 1;
  const float scale = 2 / static_cast<float>(mask);
  const auto coordinate = [&](uint32_t bits_of_it) {
    return static_cast<float>(static_cast<int32_t>(bits_of_it & mask)) * scale - 1;
  };
  Vec3 v(coordinate(packed >> bits), coordinate(packed), 0);
  v.z = 1 - std::abs(v.x) - std::abs(v.y);
  const float fold = std::max(-v.z, 0.0f);
  v.x += select(v.x < 0, fold, -fold);
  v.y += select(v.y < 0, fold, -fold);
  return v;
}
inline Vec3 unpack_direction(uint32_t packed, int bits) { return glm::normalize(unfold_direction(packed, bits)); }

class Photon {
 public:
  static constexpr int kNormalBits = 15, kDirectionBits = 10;
  // Lengths are clamped to this.
  static constexpr int kMaxLength = 63;
  // Positions of the direction and of the length in `packed_rest`.
  static constexpr int kDirectionShift = 12, kLengthShift = 6;

  Photon() = default;
  // `direction` points back along the path; `length` is its number of edges; `state` is below 64.
  Photon(const Vec3& position, const Vec3& direction, const Vec3& normal, const Rgb& power, int length,
         uint8_t state = 0)
      : Photon(position, pack_direction(direction, kDirectionBits), pack_direction(normal, kNormalBits), power, length,
               state) {}
  // The same with packed direction and normal.
  Photon(const Vec3& position, uint32_t direction, uint32_t normal, const Rgb& power, int length, uint8_t state)
      : position_(position),
        normal_(normal),
        power_(power),
        packed_(direction << kDirectionShift | static_cast<uint32_t>(std::min(length, kMaxLength)) << kLengthShift |
                state) {}

  // The stored values.
  struct Packed {
    Vec3 position;
    uint32_t normal;
    Rgb power;
    uint32_t rest;
  };
  explicit Photon(const Packed& p) : position_(p.position), normal_(p.normal), power_(p.power), packed_(p.rest) {}
  uint32_t packed_normal() const { return normal_; }
  uint32_t packed_rest() const { return packed_; }

  const Vec3& position() const { return position_; }
  const Rgb& power() const { return power_; }  // lm; in volumes: lm m (photon_paths.h)
  void scale_power(float factor) { power_ *= factor; }
  Vec3 normal() const { return unpack_direction(normal_, kNormalBits); }
  Vec3 direction() const { return unpack_direction(packed_ >> kDirectionShift, kDirectionBits); }
  Vec3 unnormalized_direction() const { return unfold_direction(packed_ >> kDirectionShift, kDirectionBits); }
  int length() const { return static_cast<int>(packed_ >> kLengthShift & kMaxLength); }
  uint8_t state() const { return packed_ & 63; }

 private:
  Vec3 position_{0};
  uint32_t normal_ = 0;
  Rgb power_{0};
  uint32_t packed_ = 0;
};

static_assert(sizeof(Photon) == 32);

}  // namespace etendue::photon
