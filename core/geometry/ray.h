// A ray with unit direction; intersections are searched in [tnear, tfar].
#pragma once
#include "base/vec.h"

namespace etendue {

struct Ray {
  Vec3 origin{0};
  float tnear = 0;
  Vec3 direction{0, 0, 1};
  float tfar = kInfinity;
};

}  // namespace etendue
