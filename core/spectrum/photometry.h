// Watts and lumens, side by side.                                                     thesis 3.4, table 3.2 (L7802)
//
// A photometric quantity is the luminance Y of the radiometric one times a luminous efficacy, which is that of the
// light's whole spectrum: three bands do not know it, so it is chosen.
#pragma once
#include <array>

#include "base/parameter.h"
#include "spectrum/rgb.h"

namespace etendue {

enum class Efficacy : uint8_t { equal_energy, standard, daylight, maximal };

// Lumens to a watt of white light.
constexpr double lumens_per_watt(Efficacy efficacy) {
  switch (efficacy) {
    case Efficacy::equal_energy:
      return 683.0 * 107 / 500;
    case Efficacy::standard:
      return 179;
    case Efficacy::daylight:
      return 115;
    case Efficacy::maximal:
      return 683;
  }
  return 683;
}

// cd/m^2 of W/(m^2 sr), lx of W/m^2, lm of W, cd of W/sr.
constexpr double photometric(const Rgb& radiometric, Efficacy efficacy) {
  return static_cast<double>(luminance(radiometric)) * lumens_per_watt(efficacy);
}

}  // namespace etendue

template <>
struct etendue::Options<etendue::Efficacy> {
  static constexpr std::array<etendue::Option, 4> kOptions{{{"equal-energy", "Equal energy, 300-800 nm: 146 lm/W"},
                                                            {"standard", "Visible white light: 179 lm/W"},
                                                            {"daylight", "Daylight with its infrared: 115 lm/W"},
                                                            {"maximal", "Green of 555 nm: 683 lm/W"}}};
};
