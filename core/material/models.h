// Every reflection model, in the order of the thesis; one line each.
//
// Of those that it names, He and Torrance's is missing: its wave-optical terms could be checked here against neither
// the paper nor a limit that would tell a wrong factor from a right one.
#pragma once
#include "material/models/ashikhmin_shirley.h"
#include "material/models/blinn_phong.h"
#include "material/models/cook_torrance.h"
#include "material/models/dielectric.h"
#include "material/models/eon.h"
#include "material/models/fresnel_mirror.h"
#include "material/models/lafortune.h"
#include "material/models/lambert.h"
#include "material/models/merl.h"
#include "material/models/mirror.h"
#include "material/models/modified_phong.h"
#include "material/models/oren_nayar.h"
#include "material/models/phong.h"
#include "material/models/phong_1975.h"
#include "material/models/reciprocal_phong.h"
#include "material/models/rgl.h"
#include "material/models/schlick.h"
#include "material/models/spherical_harmonics.h"
#include "material/models/tabulated.h"
#include "material/models/thin_sheet.h"
#include "material/models/torrance_sparrow.h"
#include "material/models/ward.h"
#include "material/type_list.h"

namespace etendue {

// clang-format off
using ReflectionModels = TypeList<
    MirrorModel,
    FresnelMirrorModel,
    DielectricModel,
    ThinSheetModel,
    LambertModel,
    Phong1975Model,
    PhongModel,
    ReciprocalPhongModel,
    ModifiedPhongModel,
    BlinnPhongModel,
    CookTorranceModel,
    TorranceSparrowModel,
    WardModel,
    OrenNayarModel,
    EonModel,
    AshikhminShirleyModel,
    LafortuneModel,
    SchlickModel,
    RglModel,
    MerlModel,
    TabulatedModel,
    SphericalHarmonicsModel>;
// clang-format on

}  // namespace etendue
