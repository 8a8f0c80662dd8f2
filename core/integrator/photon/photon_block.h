// Sixteen photons of a leaf of the photon map, in 32 bytes each.
//
// What a lookup tests is in structure-of-arrays layout, for vector instructions; the rest is needed only of the photons
// that are found.
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
    rest[i] = {photon.power(), photon.packed_rest()};
  }
  Photon operator[](size_t i) const {
    return Photon(Photon::Packed{{x[i], y[i], z[i]}, normals[i], rest[i].power, rest[i].packed});
  }

  struct Rest {
    Rgb power{0};
    uint32_t packed = 0;  // direction, length and state
  };
  alignas(64) std::array<float, kSize> x, y, z;
  std::array<uint32_t, kSize> normals{};
  std::array<Rest, kSize> rest{};
};

static_assert(sizeof(PhotonBlock) == 32 * PhotonBlock::kSize);

using BlockDistances = std::array<float, PhotonBlock::kSize>;

// The squared distances of the photons of a block to a point.
void find_distances(const PhotonBlock& block, const Vec3& position, BlockDistances& distances2);
// The same, but infinite for photons that cannot lie on the same surface as the point: its normal is less than 60
// degrees away, and it is less than 30 degrees above or below the tangent plane. This excludes photons beyond edges and
// on the other side of thin walls. On curved surfaces the criterion becomes exact as the disc shrinks.
void find_distances_on_surface(const PhotonBlock& block, const Vec3& position, const Vec3& normal,
                               BlockDistances& distances2);

}  // namespace etendue::photon
