// A chart of a spectrum over the visible wavelengths.
#pragma once
#include <functional>

#include "spectrum/wavelengths.h"
#include "viewer/viewport/placement.h"
#include "viewer/widgets/plot.h"

namespace etendue::viewer {

struct UiContext;

// Four times the same wavelength, in nm.
Wavelengths only_wavelength(double wavelength);

using SpectrumFunction = std::function<double(double)>;  // of the wavelength in nm
// The largest value at the wavelengths of the chart.
double largest_value(const SpectrumFunction& value);
// Draws a spectrum in a frame of the window, with an axis up to `high`, and returns the chart.
Plot draw_spectrum_plot(const UiContext& ui, const Placement& frame, const char* title, double high,
                        const SpectrumFunction& value);

// Draws value(wavelength in nm) over the width of the panel; the highest value of the axis is at least `at_least`. The
// area below the curve has the colours of the wavelengths.
void spectrum_plot(UiContext& ui, const char* item, const char* title, double at_least, const SpectrumFunction& value);

}  // namespace etendue::viewer
