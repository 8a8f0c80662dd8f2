// The registry of BSDF models, in the order of [Lang, ch. 4]: one include and one line each.
//
// The model of He and Torrance [He et al. 1991], which the thesis also names, is not implemented: its wave-optical
// terms cannot be verified without the paper or a known limit.
#pragma once
#include "bsdf/models/ashikhmin_shirley_model.h"
#include "bsdf/models/blinn_phong_model.h"
#include "bsdf/models/cook_torrance_model.h"
#include "bsdf/models/dielectric_model.h"
#include "bsdf/models/dipole_model.h"
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
#include "bsdf/models/subsurface_model.h"
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
    SubsurfaceModel,
    DipoleModel,
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
