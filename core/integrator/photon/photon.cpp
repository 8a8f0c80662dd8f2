#include "integrator/photon/photon.h"

namespace etendue::photon {

ETENDUE_VECTORIZE void packed_directions(const Vec3LanesView& v, size_t count, int bits, uint32_t* packed) {
#pragma GCC ivdep
  for (size_t i = 0; i < padded_lanes(count); ++i) packed[i] = packed_direction(v[i], bits);
}

}  // namespace etendue::photon
