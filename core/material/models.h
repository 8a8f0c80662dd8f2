// Every reflection model, in the order of the thesis; one line each.
#pragma once
#include "material/models/blinn_phong.h"
#include "material/models/lambert.h"
#include "material/models/modified_phong.h"
#include "material/models/phong.h"
#include "material/models/phong_1975.h"
#include "material/models/reciprocal_phong.h"
#include "material/type_list.h"

namespace etendue {

// clang-format off
using ReflectionModels = TypeList<
    LambertModel,
    Phong1975Model,
    PhongModel,
    ReciprocalPhongModel,
    ModifiedPhongModel,
    BlinnPhongModel>;
// clang-format on

}  // namespace etendue
