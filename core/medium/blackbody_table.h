// The emission of black bodies by temperature, relative to the luminance at the highest temperature.
#pragma once
#include <vector>

#include "spectrum/rgb.h"
#include "spectrum/wavelengths.h"

namespace etendue {

// The luminance falls with the fourth power of the temperature, as the total radiance does by the law of Stefan and
// Boltzmann. Temperatures outside of the range of blackbody.h have the colour of the closer end.
class BlackbodyTable {
 public:
  // In kelvin.
  explicit BlackbodyTable(float highest);

  // `relative` is the temperature over the highest one, in [0, 1]. Colours outside the gamut are clipped for RGB.
  Rgb at(float relative) const;
  SampledSpectrum at(float relative, const Wavelengths& wavelengths) const;

 private:
  struct Entry {
    Rgb rgb;
    float scale = 0;  // of blackbody_at over D65
  };
  struct Position {
    size_t entry = 0;
    float fraction = 0;
  };
  Position position(float relative) const;
  double kelvin(double relative) const;

  std::vector<Entry> entries_;
  float highest_;
};

}  // namespace etendue
