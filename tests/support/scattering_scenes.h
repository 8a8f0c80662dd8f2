// Scenes with scattering media, for tests of integrators.
#pragma once
#include "support/media_scenes.h"

namespace etendue::test {

// A medium with these coefficients in 1/m; g selects Henyey-Greenstein, 0 isotropic scattering.
MediumDescription medium(const Rgb& scattering, const Rgb& absorption = Rgb(0), float g = 0);
// A material whose surface only bounds a medium.
Material medium_boundary(const MediumDescription& inside);
// A clear liquid with scattering particles.
Material turbid_liquid(float ior, const MediumDescription& inside, float roughness = 0);

// The same image with a medium of coefficients zero, and another medium far away that selects the general loops.
render::Document with_clear_medium(const render::Document& plain);

// The Cornell box filled with fog, which scatters forward.
render::Document foggy_cornell_box();
// A glass of milk on a floor under an area light and a sky: the milk overlaps the wall of the glass.
render::Document glass_of_milk();
// A diffuse stone in murky water, whose coefficients depend on the colour.
render::Document stone_in_murky_water();
// A spot light and a diffuse ball in fog bounded by a box without a surface.
render::Document spot_light_in_fog();
// A camera in a ball of chromatic fog, under an area light.
render::Document camera_in_fog();

}  // namespace etendue::test
