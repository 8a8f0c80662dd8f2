// The colour of a black body of a given temperature.
//
// Planck's law, integrated against the colour matching functions of the CIE 1931 standard observer, converted to linear
// Rec. 709. Colours outside of its gamut, below about 1900 K, are clipped.
#pragma once
#include <functional>

#include "spectrum/rgb.h"

namespace etendue {

inline constexpr double kMinTemperature = 1000, kMaxTemperature = 40000;  // kelvin

// The spectral radiance of a black body relative to that at 560 nm; wavelengths in nm.                   [Planck's law]
double blackbody_at(double wavelength, double kelvin);

// The colour with a largest component of one. `kelvin` must lie in the range above.
Rgb blackbody_color(double kelvin);

// The colour of a black body behind a filter. `transmittance` is a function of the wavelength in nm. The luminance is
// relative to that without the filter.
Rgb filtered_blackbody_color(double kelvin, const std::function<double(double)>& transmittance);

// The temperature in the range above whose colour is nearest to this one, in kelvin. Brightness has no influence; black
// gives the temperature nearest to white.
double nearest_temperature(const Rgb& color);

}  // namespace etendue
