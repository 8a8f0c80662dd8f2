// The matrix that moves an object to a point.
#pragma once
#include <glm/gtc/matrix_transform.hpp>

#include "base/vec.h"

namespace etendue::test {

inline Mat4 at(const Vec3& p) { return glm::translate(Mat4(1), p); }

}  // namespace etendue::test
