// The half vector of two directions, and what a density of half vectors is for the directions that they reflect to.
#pragma once
#include "material/microfacet.h"

namespace etendue {

// Of directions on the upper side, whose sum always has a direction.
inline Vec3 half_vector(const Vec3& o, const Vec3& i) { return glm::normalize(o + i); }

// Solid angle of h over that of the reflected direction: 1 / (4 <o, h>).          thesis (4.283), item 59
inline float reflected_density(const Vec3& o, const Vec3& h) { return 1 / (4 * glm::dot(o, h)); }

}  // namespace etendue
