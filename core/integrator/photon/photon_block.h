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
void find_distances(const PhotonBlock& block, const Vec3& position, BlockDistances& distances2);
// The same, but infinite for photons that cannot lie on the same surface as the point: its normal is less than 60
// degrees away, and it is less than 30 degrees above or below the tangent plane. This excludes photons beyond edges and
// on the other side of thin walls. On curved surfaces the criterion becomes exact as the disc shrinks.
void find_distances_on_surface(const PhotonBlock& block, const Vec3& position, const Vec3& normal,
                               BlockDistances& distances2);

// Selects the photons within a radius on the same surface that a Lambertian surface reflects to one of its sides.
struct LambertianLookup {
  Vec3 position, normal;
  float radius2 = 0;
  float side = 1;      // the sign of the cosine between the normal and the direction of reflection
  int max_length = 0;  // edges of the paths of the photons
};

// The powers of photons, summed lane by lane.
struct PowerSums {
  alignas(64) std::array<float, PhotonBlock::kSize> red{}, green{}, blue{};
  Rgb total() const;
};

// Adds the powers of the selected photons of a block.
void add_powers(const PhotonBlock& block, const LambertianLookup& lookup, PowerSums& sums);

}  // namespace etendue::photon
