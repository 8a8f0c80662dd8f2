// Sixteen photons of a leaf of the photon map, in 32 bytes each and in structure-of-arrays layout, for vector
// instructions.
#pragma once
#include "integrator/photon/photon.h"

namespace etendue::photon {

struct PhotonBlock {
  static constexpr size_t kSize = 16;

  // Without photons: all are infinitely far away.
  PhotonBlock() {
    x.fill(kInfinity);
    y.fill(kInfinity);
    z.fill(kInfinity);
  }

  void set(size_t i, const Photon& photon) {
    x[i] = photon.position().x;
    y[i] = photon.position().y;
    z[i] = photon.position().z;
    normals[i] = photon.packed_normal();
    red[i] = photon.power().r;
    green[i] = photon.power().g;
    blue[i] = photon.power().b;
    packed[i] = photon.packed_rest();
  }
  Photon operator[](size_t i) const {
    return Photon(Photon::Packed{{x[i], y[i], z[i]}, normals[i], {red[i], green[i], blue[i]}, packed[i]});
  }

  alignas(64) std::array<float, kSize> x, y, z;
  std::array<uint32_t, kSize> normals{};
  std::array<float, kSize> red{}, green{}, blue{};  // power
  std::array<uint32_t, kSize> packed{};             // direction, length and state
};

static_assert(sizeof(PhotonBlock) == 32 * PhotonBlock::kSize);

using BlockDistances = std::array<float, PhotonBlock::kSize>;

// The squared distances of the photons of a block to a point.
inline void find_distances(const PhotonBlock& block, const Vec3& position, BlockDistances& distances2) {
#pragma GCC ivdep
  for (size_t i = 0; i < PhotonBlock::kSize; ++i)
    distances2[i] = sqr(block.x[i] - position.x) + sqr(block.y[i] - position.y) + sqr(block.z[i] - position.z);
}

// The squared distance of a photon to a point. It is infinite if the photon cannot lie on the same surface: its normal
// must be less than 60 degrees away, and it must be less than 30 degrees above or below the tangent plane. This excludes
// photons beyond edges and on the other side of thin walls. On curved surfaces the criterion becomes exact as the disc
// shrinks.
//
// Bitwise operations, because branches would keep loops from being vectorised.
inline float distance2_on_surface(const PhotonBlock& block, size_t i, const Vec3& position, const Vec3& normal) {
  const Vec3 d(block.x[i] - position.x, block.y[i] - position.y, block.z[i] - position.z);
  const float distance2 = glm::dot(d, d);
  const Vec3 n = unfold_direction(block.normals[i], Photon::kNormalBits);
  const float cosine = glm::dot(n, normal);
  const bool is_level = sqr(glm::dot(d, normal)) <= 0.25f * distance2;
  const bool faces = static_cast<bool>((cosine > 0) & (sqr(cosine) > 0.25f * glm::dot(n, n)));
  return is_level & faces ? distance2 : kInfinity;
}
inline void find_distances_on_surface(const PhotonBlock& block, const Vec3& position, const Vec3& normal,
                                      BlockDistances& distances2) {
#pragma GCC ivdep
  for (size_t i = 0; i < PhotonBlock::kSize; ++i) distances2[i] = distance2_on_surface(block, i, position, normal);
}

// The photons that a Lambertian surface reflects to one of its sides.
struct LambertianSide {
  Vec3 normal;
  float side = 1;      // the sign of the cosine between the normal and the direction of reflection
  int max_length = 0;  // edges of the paths of the photons
};

// The powers of photons, summed lane by lane.
struct PowerSums {
  alignas(64) std::array<float, PhotonBlock::kSize> red{}, green{}, blue{};

  Rgb total() const { return {sum_of(red), sum_of(green), sum_of(blue)}; }

 private:
  static float sum_of(std::array<float, PhotonBlock::kSize> values) {
    for (size_t half = PhotonBlock::kSize / 2; half > 0; half /= 2)
      for (size_t i = 0; i < half; ++i) values[i] += values[i + half];
    return values[0];
  }
};

// Adds the powers of the photons within a radius that a Lambertian surface reflects.
inline void add_powers(const PhotonBlock& block, const BlockDistances& distances2, float radius2,
                       const LambertianSide& side, PowerSums& sums) {
  // Signs of cosines do not depend on the length of the unfolded directions.
#pragma GCC ivdep
  for (size_t i = 0; i < PhotonBlock::kSize; ++i) {
    const Vec3 wi = unfold_direction(block.packed[i] >> Photon::kDirectionShift, Photon::kDirectionBits);
    const int length = static_cast<int>(block.packed[i] >> Photon::kLengthShift & Photon::kMaxLength);
    const bool selected = static_cast<bool>((distances2[i] < radius2) & (glm::dot(wi, side.normal) * side.side > 0) &
                                            (length <= side.max_length));
    sums.red[i] += selected ? block.red[i] : 0;
    sums.green[i] += selected ? block.green[i] : 0;
    sums.blue[i] += selected ? block.blue[i] : 0;
  }
}

}  // namespace etendue::photon
