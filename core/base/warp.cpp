#include "base/warp.h"

namespace etendue {

ETENDUE_VECTORIZE void squares_to_cosine_hemisphere(const float* u0, const float* u1, size_t count,
                                                    const Vec3LanesView& directions) {
#pragma GCC ivdep
  for (size_t i = 0; i < padded_lanes(count); ++i) {
    const Vec3 d = square_to_cosine_hemisphere({u0[i], u1[i]});
    directions.set(i, d);
  }
}

}  // namespace etendue
