// The registry of phase functions, in the order of [Lang, sec. 4.2.4]: one include and one line each.
#pragma once
#include <tuple>

#include "medium/phase_functions/cornette_shanks.h"
#include "medium/phase_functions/double_henyey_greenstein.h"
#include "medium/phase_functions/henyey_greenstein.h"
#include "medium/phase_functions/isotropic.h"
#include "medium/phase_functions/mie_hazy.h"
#include "medium/phase_functions/mie_murky.h"
#include "medium/phase_functions/modified_henyey_greenstein.h"
#include "medium/phase_functions/multi_lobe_henyey_greenstein.h"
#include "medium/phase_functions/rayleigh.h"
#include "medium/phase_functions/schlick_phase.h"
#include "medium/phase_functions/tabulated_phase.h"

namespace etendue {

// clang-format off
using PhaseFunctions = std::tuple<
    IsotropicPhase,
    HenyeyGreenstein,
    ModifiedHenyeyGreenstein,
    MultiLobeHenyeyGreenstein,
    DoubleHenyeyGreenstein,
    SchlickPhase,
    CornetteShanks,
    RayleighPhase,
    MieHazy,
    MieMurky,
    TabulatedPhase>;
// clang-format on

}  // namespace etendue
