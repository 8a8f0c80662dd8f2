// Spectra as lists of points in text, such as "400:0.2 550:1 700:0.5": wavelengths in nm and values.
//
// They stand where the name of a spectrum does, so that a spectrum can be edited without a file.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "spectrum/spectrum.h"

namespace etendue {

// Whether a text is to be read as a list of points: it begins with a number and a colon.
bool is_point_list(std::string_view text);

// The points of a text. An error names the first part that is not WAVELENGTH:VALUE. Spectrum::piecewise_linear checks
// order and range of the points.
Result<std::vector<Spectrum::Sample>> parse_points(std::string_view text);
// The linear spectrum between the points of a text.
Result<Spectrum> spectrum_of_points(std::string_view text);

// The text of these points: wavelengths to 0.1 nm, values with five significant digits.
std::string text_of_points(std::span<const Spectrum::Sample> points);

// The points that remain if all are removed whose value differs by at most `tolerance` from the line through their
// remaining neighbours. The first and the last point remain.                               [Douglas and Peucker 1973]
std::vector<Spectrum::Sample> simplified_points(std::span<const Spectrum::Sample> points, double tolerance);

}  // namespace etendue
