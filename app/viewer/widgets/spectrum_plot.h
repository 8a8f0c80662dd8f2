// A chart of a spectrum over the visible wavelengths.
#pragma once
#include <functional>

namespace etendue::viewer {

struct UiContext;

// Draws value(wavelength in nm) over the width of the panel; the highest value of the axis is at least `at_least`. The
// area below the curve has the colours of the wavelengths.
void spectrum_plot(UiContext& ui, const char* item, const char* title, double at_least,
                   const std::function<double(double)>& value);

}  // namespace etendue::viewer
