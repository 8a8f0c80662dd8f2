#include "integrator/photon/photon_block.h"

namespace etendue::photon {

ETENDUE_VECTORIZE void find_distances(const PhotonBlock& block, const Vec3& position, BlockDistances& distances2) {
#pragma GCC ivdep
  for (size_t i = 0; i < PhotonBlock::kSize; ++i)
    distances2[i] = sqr(block.x[i] - position.x) + sqr(block.y[i] - position.y) + sqr(block.z[i] - position.z);
}

ETENDUE_VECTORIZE void find_distances_on_surface(const PhotonBlock& block, const Vec3& position, const Vec3& normal,
                                                 BlockDistances& distances2) {
#pragma GCC ivdep
  for (size_t i = 0; i < PhotonBlock::kSize; ++i) {
    const Vec3 d(block.x[i] - position.x, block.y[i] - position.y, block.z[i] - position.z);
    const float distance2 = glm::dot(d, d);
    const Vec3 n = unfold_direction(block.normals[i], Photon::kNormalBits);
    const float cosine = glm::dot(n, normal);
    // Bitwise, because branches would keep the loop from being vectorised.
    const bool is_level = sqr(glm::dot(d, normal)) <= 0.25f * distance2;
    const bool faces = static_cast<bool>((cosine > 0) & (sqr(cosine) > 0.25f * glm::dot(n, n)));
    distances2[i] = is_level & faces ? distance2 : kInfinity;
  }
}

}  // namespace etendue::photon
