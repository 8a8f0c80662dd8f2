// A clear sky with a sun, above a Lambertian ground.                                        [Preetham et al. 1999]
//
// The luminance and the chromaticity of the sky are functions of the angles to the zenith and to the sun [Perez et al.
// 1993], with coefficients that depend on the turbidity. The sun is a disk of 0.533 degrees: a black body of 5778 K
// with an illuminance of 128 klx above the atmosphere, attenuated by Rayleigh scattering, aerosols and ozone along the
// air mass of its elevation [Kasten 1966; Leckner 1978], with the limb darkening of visible light, u = 0.6. The ground
// has the radiance albedo E / pi, E the illuminance of the horizontal by sky and sun.
//
// Limits: the fit holds for turbidities from 2 to 6 and becomes inaccurate for hazier air. With a high sun and clear
// air the sky has up to 1.8 times the illuminance of handbooks (15 klx at 60 degrees). Close to sunset it is too dark
// around the sun and too bright opposite to it. The ground does not brighten the sky. There is no twilight: at night the
// sky stays that of sunset, without the sun.
#pragma once
#include "light/environments/builtin_environment.h"
#include "light/environments/sun.h"

namespace etendue {

inline constexpr float kLargestTurbidity = 10;
constexpr float least_turbidity(SkyModel model) { return model == SkyModel::preetham ? 2 : 1; }

// cd/m^2 above the horizon, from a unit direction, without the sun itself, of either model (hosek_model.h).
Rgb sky_radiance(const Sky& sky, const Vec3& direction);

// The environment with this sky. Equal skies in use share their map.
Environment make_sky(const Sky& sky);
inline Environment make_default_sky() { return make_sky({}); }

constexpr BuiltinEnvironment kSky{.name = "sky",
                                  .label = "Sky and sun",
                                  .doc =
                                      "A clear sky with a sun of chosen elevation, in cd/m\u00b2 as outdoors: far "
                                      "brighter than the other environments",
                                  .radiance = nullptr,
                                  .make = make_default_sky};

}  // namespace etendue
