// A clear sky with a sun, above a Lambertian ground that brightens it.                        [Hosek and Wilkie 2012]
#pragma once
#include "light/environments/hosek_model.h"
#include "light/environments/sky.h"

namespace etendue {

inline Environment make_default_hosek_sky() { return make_sky({.model = SkyModel::hosek_wilkie}); }

constexpr BuiltinEnvironment kHosekSky{.name = kHosekSkyName,
                                       .label = "Sky and sun (Hosek-Wilkie)",
                                       .doc =
                                           "A clear sky with a sun, more accurate close to the horizon and at low suns "
                                           "than the sky of Preetham, in cd/m\u00b2",
                                       .radiance = nullptr,
                                       .make = make_default_hosek_sky};

}  // namespace etendue
