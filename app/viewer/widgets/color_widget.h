// Widgets for three parameters NAME.r, NAME.g and NAME.b.
//
// Parameters are linear numbers; swatches, pickers and hexadecimal values are sRGB, as everywhere where colours are
// chosen by eye.
#pragma once
#include <span>
#include <string>

namespace etendue::render {
struct DocumentParameter;
}

namespace etendue::viewer {

struct AppState;

// A reflectance or another factor of at most one is edited as a colour; a radiance as three numbers with a swatch; what
// is not a colour, such as an index of refraction, as three numbers.
void color_widget(AppState& state, std::span<const render::DocumentParameter> rgb);

// A field for the temperature of the black body whose colour is nearest to the parameters NAME.r, NAME.g and NAME.b. An
// edit sets the colour. `name` is NAME with its section, as in "light.0.color"; scripts find the field as `item`.
void temperature_widget(AppState& state, const std::string& name, const std::string& item);

// A field for the largest of the parameters NAME.r, NAME.g and NAME.b in EV: 0 EV is 1. An edit scales all three. Nothing is
// drawn while they are zero.
void strength_widget(AppState& state, const std::string& name, const std::string& item);

}  // namespace etendue::viewer
