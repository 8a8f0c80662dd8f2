// Conversion of radiometric to photometric quantities                              [Lang, sec. 3.4, table 3.2]
//
// A photometric quantity is the luminance Y of the radiometric quantity times a luminous efficacy. The efficacy is a
// property of the whole spectrum, which RGB values do not determine. It is therefore a choice of the user.
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

// Radiance in W/(m^2 sr) to luminance in cd/m^2, irradiance in W/m^2 to illuminance in lx, power in W to luminous flux
// in lm, or intensity in W/sr to luminous intensity in cd.
constexpr double photometric(const Rgb& radiometric, Efficacy efficacy) {
  return static_cast<double>(luminance(radiometric)) * lumens_per_watt(efficacy);
}

}  // namespace etendue

template <>
struct etendue::Options<etendue::Efficacy> {
  static constexpr std::array<etendue::Option, 4> kOptions{
      {{"equal-energy", "Equal-energy spectrum, 300-800 nm (146 lm/W)"},
       {"standard", "Visible white light (179 lm/W)"},
       {"daylight", "Daylight including infrared (115 lm/W)"},
       {"maximal", "Monochromatic light of 555 nm (683 lm/W)"}}};
};
