// Widgets for three parameters NAME.r, NAME.g and NAME.b.
//
// Parameters are linear numbers; swatches, pickers and hexadecimal values are sRGB, as everywhere where colours are
// chosen by eye.
#pragma once
#include <span>

namespace etendue::render {
struct DocumentParameter;
}

namespace etendue::viewer {

struct AppState;

// A reflectance or another factor of at most one is edited as a colour; a radiance as three numbers with a swatch; what
// is not a colour, such as an index of refraction, as three numbers.
void color_widget(AppState& state, std::span<const render::DocumentParameter> rgb);

}  // namespace etendue::viewer
