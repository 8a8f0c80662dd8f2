// Every light type; one line each.
#pragma once
#include "light/types/ambient_light.h"
#include "light/types/cylinder_light.h"
#include "light/types/directional_light.h"
#include "light/types/disk_light.h"
#include "light/types/photometric_light.h"
#include "light/types/point_light.h"
#include "light/types/projector_light.h"
#include "light/types/quad_light.h"
#include "light/types/sphere_light.h"
#include "light/types/spot_light.h"

namespace etendue {

template <class... Type>
struct LightTypeList {};

// clang-format off
using LightTypes = LightTypeList<
    PointLight,
    SpotLight,
    DirectionalLight,
    QuadLight,
    DiskLight,
    SphereLight,
    CylinderLight,
    PhotometricLight,
    ProjectorLight,
    AmbientLight>;
// clang-format on

}  // namespace etendue
