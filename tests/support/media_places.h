// Scenes of solids in each other, for what depends on the media along a path.
#pragma once
#include "support/places.h"

namespace etendue::test {

// A solid of this index of refraction that leaves this part of light on each metre.
Material liquid(float ior, const Rgb& per_metre = Rgb(1), float roughness = 0);

// A mesh with both surfaces of a hollow ball.
std::shared_ptr<const Mesh> shell(float outer, float inner, int rings);

// A clay ball in a box of tinted water under a sky and a lamp.
render::Document stone_in_tinted_water();

// A ball of ice in water in a glass bowl. The water ends inside the wall of the bowl, or its surface is the inner one
// of the wall.
render::Document ice_in_water_in_glass(bool overlapping);

// A ball of tinted glass with a bubble of air, on a floor.
render::Document bubble();

// A lamp and a clay ball in tinted water, seen from outside, or from inside the water.
render::Document lamp_in_tinted_water(bool camera_inside);

// A camera in tinted glass that holds a ball of clay and a bubble, under a sky.
render::Document camera_inside_glass();

}  // namespace etendue::test
