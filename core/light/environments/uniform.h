// The same radiance from everywhere.
#pragma once
#include "light/environments/builtin_environment.h"

namespace etendue {

constexpr BuiltinEnvironment kUniform{
    .name = "uniform",
    .label = "Uniform",
    .doc = "Radiance 1 from all directions: an energy-conserving white object has the same radiance",
    .radiance = nullptr};

}  // namespace etendue
