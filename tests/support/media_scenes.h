// Scenes with nested solids, for tests of the media along a path.
#pragma once
#include "support/integrator_scenes.h"

namespace etendue::test {

// A solid with this index of refraction and this transmittance per metre.
Material liquid(float ior, const Rgb& per_metre = Rgb(1), float roughness = 0);

// A mesh of the outer and the inner surface of a hollow ball.
std::shared_ptr<const Mesh> shell(float outer, float inner, int rings);

// A diffuse ball in a box of tinted water, under a sky and an area light.
render::Document stone_in_tinted_water();

// A ball of ice in water in a glass bowl. The water overlaps the wall of the bowl or coincides with its inner surface.
render::Document ice_in_water_in_glass(bool overlapping);

// A ball of tinted glass with an air bubble, on a floor.
render::Document bubble();

// An area light and a diffuse ball in tinted water, seen from outside or from inside the water.
render::Document light_in_tinted_water(bool camera_inside);

// A camera in tinted glass with a diffuse ball and an air bubble in it, under a sky.
render::Document camera_inside_glass();

}  // namespace etendue::test
