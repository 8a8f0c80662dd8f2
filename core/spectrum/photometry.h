// Units of light, and the conversion between photometric and radiometric quantities      [Lang, sec. 3.4, table 3.2]
//
// The numbers of scenes and images are photometric, as in glTF: the luminance Y of a linear RGB value is in cd/m^2, in
// lx, in cd, or in lm. No computation of light transport depends on this choice, because it is linear. A radiometric
// quantity is the luminance Y divided by a luminous efficacy. The efficacy is a property of the whole spectrum, which
// RGB values do not determine. It is therefore a choice of the user.
#pragma once
#include <array>

#include "base/parameter.h"
#include "spectrum/rgb.h"

namespace etendue {

enum class Efficacy : uint8_t { equal_energy, standard, daylight, maximal };

// The luminous efficacy of white light with this spectrum in lm/W.
constexpr double lumens_per_watt(Efficacy efficacy) {
  switch (efficacy) {
    case Efficacy::equal_energy:
      return 683.0 * 107 / 500;  // the integral of V(lambda) is 107 nm, that of the spectrum 500 nm
    case Efficacy::standard:
      return 179;
    case Efficacy::daylight:
      return 115;
    case Efficacy::maximal:
      return 683;
  }
  return 683;
}

// Luminance in cd/m^2 to radiance in W/(m^2 sr), illuminance in lx to irradiance in W/m^2, luminous flux in lm to power
// in W, or luminous intensity in cd to radiant intensity in W/sr.
constexpr double radiometric(double photometric, Efficacy efficacy) { return photometric / lumens_per_watt(efficacy); }

}  // namespace etendue

template <>
struct etendue::Options<etendue::Efficacy> {
  static constexpr std::array<etendue::Option, 4> kOptions{{{"equal-energy", "146 lm/W, equal energy"},
                                                            {"standard", "179 lm/W, white light"},
                                                            {"daylight", "115 lm/W, daylight"},
                                                            {"maximal", "683 lm/W, 555 nm"}}};
};
