// Every reflection model, in the order of the thesis; one line each.
//
// Of those that it names, He and Torrance's is missing: its wave-optical terms could be checked here against neither
// the paper nor a limit that would tell a wrong factor from a right one.
#pragma once
#include "bsdf/models/ashikhmin_shirley_model.h"
#include "bsdf/models/blinn_phong_model.h"
#include "bsdf/models/cook_torrance_model.h"
#include "bsdf/models/dielectric_model.h"
#include "bsdf/models/eon_model.h"
#include "bsdf/models/fresnel_mirror_model.h"
#include "bsdf/models/lafortune_model.h"
#include "bsdf/models/lambert_model.h"
#include "bsdf/models/merl_model.h"
#include "bsdf/models/mirror_model.h"
#include "bsdf/models/modified_phong_model.h"
#include "bsdf/models/oren_nayar_model.h"
#include "bsdf/models/phong_1975_model.h"
#include "bsdf/models/phong_model.h"
#include "bsdf/models/reciprocal_phong_model.h"
#include "bsdf/models/rgl_model.h"
#include "bsdf/models/schlick_model.h"
#include "bsdf/models/spherical_harmonics_model.h"
#include "bsdf/models/tabulated_model.h"
#include "bsdf/models/thin_dielectric_model.h"
#include "bsdf/models/torrance_sparrow_model.h"
#include "bsdf/models/ward_model.h"
#include "bsdf/type_list.h"

namespace etendue {

// clang-format off
using BsdfModels = TypeList<
    MirrorModel,
    FresnelMirrorModel,
    DielectricModel,
    ThinDielectricModel,
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
