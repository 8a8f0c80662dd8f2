// The CIE 1931 2-degree standard observer, and linear sRGB values of spectra.          [CIE 1931; IEC 61966-2-1]
//
// Wavelengths are in nanometres. Tables have steps of 5 nm from 380 to 780 nm and are interpolated linearly; outside,
// the observer is 0. The neglected part of the integral of V(lambda) is 5e-5.
#pragma once
#include <array>
#include <functional>

#include "spectrum/rgb.h"

namespace etendue {

inline constexpr double kFirstWavelength = 380, kLastWavelength = 780, kWavelengthStep = 5;
inline constexpr size_t kWavelengths = 81;  // of the tables

constexpr double table_wavelength(size_t i) { return kFirstWavelength + kWavelengthStep * static_cast<double>(i); }

struct Xyz {
  double x = 0, y = 0, z = 0;
};

// The colour matching functions.
Xyz observer_at(double wavelength);

// The relative power of the CIE standard illuminant D65; 100 at 560 nm.
double d65_at(double wavelength);

// The integral of a spectrum times the colour matching functions, in the unit of the spectrum times nm.
Xyz xyz_of(const std::function<double(double)>& spectrum);

// The weights of the linear sRGB values of a spectrum that is given relative to illuminant D65:
//
//   rgb = integral of s(lambda) w(lambda) d lambda,       w = M (x, y, z) D65,  integral of w = (1, 1, 1)
//
// M maps XYZ to linear Rec. 709 with the white point of the tabulated D65. Interpolated linearly; 1/nm.
std::array<double, 3> relative_rgb_weights(double wavelength);

// The linear sRGB value of a spectrum relative to D65: 1 for a constant 1. Components outside the gamut are negative.
std::array<double, 3> relative_rgb_of(const std::function<double(double)>& spectrum);

// Linear sRGB of an XYZ colour whose white is that of the tabulated D65.
std::array<double, 3> rgb_of(const Xyz& color);

}  // namespace etendue
