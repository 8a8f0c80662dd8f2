// The registry of densities: one include and one line each.
#pragma once
#include <tuple>

#include "medium/densities/ball_density.h"
#include "medium/densities/cloud_density.h"
#include "medium/densities/constant_density.h"
#include "medium/densities/exponential_density.h"
#include "medium/densities/file_density.h"
#include "medium/densities/flame_density.h"
#include "medium/densities/linear_density.h"

namespace etendue {

// clang-format off
using Densities = std::tuple<
    ConstantDensity,
    LinearDensity,
    ExponentialDensity,
    BallDensity,
    CloudDensity,
    FlameDensity,
    FileDensity>;
// clang-format on

}  // namespace etendue
