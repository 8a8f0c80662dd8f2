#include "integrator/photon/photon_block.h"

#include <numeric>

namespace etendue::photon {
namespace {

// The squared distance of a photon, infinite if it cannot lie on the same surface. Bitwise operations, because branches
// would keep loops from being vectorised.
inline float distance2_on_surface(const PhotonBlock& block, size_t i, const Vec3& position, const Vec3& normal) {
  const Vec3 d(block.x[i] - position.x, block.y[i] - position.y, block.z[i] - position.z);
  const float distance2 = glm::dot(d, d);
  const Vec3 n = unfold_direction(block.normals[i], Photon::kNormalBits);
  const float cosine = glm::dot(n, normal);
  const bool is_level = sqr(glm::dot(d, normal)) <= 0.25f * distance2;
  const bool faces = static_cast<bool>((cosine > 0) & (sqr(cosine) > 0.25f * glm::dot(n, n)));
  return is_level & faces ? distance2 : kInfinity;
}

float sum_of(const std::array<float, PhotonBlock::kSize>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0f);
}

}  // namespace

ETENDUE_VECTORIZE void find_distances(const PhotonBlock& block, const Vec3& position, BlockDistances& distances2) {
#pragma GCC ivdep
  for (size_t i = 0; i < PhotonBlock::kSize; ++i)
    distances2[i] = sqr(block.x[i] - position.x) + sqr(block.y[i] - position.y) + sqr(block.z[i] - position.z);
}

ETENDUE_VECTORIZE void find_distances_on_surface(const PhotonBlock& block, const Vec3& position, const Vec3& normal,
                                                 BlockDistances& distances2) {
#pragma GCC ivdep
  for (size_t i = 0; i < PhotonBlock::kSize; ++i) distances2[i] = distance2_on_surface(block, i, position, normal);
}

Rgb PowerSums::total() const { return {sum_of(red), sum_of(green), sum_of(blue)}; }

// Signs of cosines do not depend on the length of the unfolded directions.
ETENDUE_VECTORIZE void add_powers(const PhotonBlock& block, const LambertianLookup& lookup, PowerSums& sums) {
#pragma GCC ivdep
  for (size_t i = 0; i < PhotonBlock::kSize; ++i) {
    const float distance2 = distance2_on_surface(block, i, lookup.position, lookup.normal);
    const Vec3 wi = unfold_direction(block.packed[i] >> Photon::kDirectionShift, Photon::kDirectionBits);
    const int length = static_cast<int>(block.packed[i] >> Photon::kLengthShift & Photon::kMaxLength);
    const bool selected = static_cast<bool>(
        (distance2 < lookup.radius2) & (glm::dot(wi, lookup.normal) * lookup.side > 0) & (length <= lookup.max_length));
    sums.red[i] += selected ? block.red[i] : 0;
    sums.green[i] += selected ? block.green[i] : 0;
    sums.blue[i] += selected ? block.blue[i] : 0;
  }
}

}  // namespace etendue::photon
