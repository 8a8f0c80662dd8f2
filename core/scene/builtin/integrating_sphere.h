// A diffuse sphere seen from within, one cap of which shines: what every method must say of it is known in closed form.
//
// Between any two points of a sphere of radius R the geometric term is 1/(4 R^2), so that a walk's vertices are uniform
// over it and independent. Let the cap have the share a of the area and radiance one, and all of it the albedo rho:
//
//   reflected radiance  m = rho a / (1 - rho)            rho a / (1 - rho (1 - a)) where the cap itself is black
//   hits alone          variance of a walk a (1 - a) rho^2 / (1 - rho^2)    rho^2 a / (1 - rho^2 (1 - a)) - m^2
//   k edges             a rho^(k-1), k >= 2
//
// It is made of triangles: they lie within the sphere by 1e-4 of the radius at most, the cap's share is a within 1e-4
// of it, radiance is off by about as much, and what would be a constant has a relative variance of 5e-5.
#pragma once
#include "scene/scene.h"

namespace etendue::scene {

enum class Cap { reflecting, black };

// Of radius one around the origin, the cap at +y; 0 < share <= 1/2.
Scene integrating_sphere(double share, float albedo, Cap cap = Cap::reflecting);

// At the middle of the sphere, looking away from the cap.
Camera integrating_sphere_camera();

}  // namespace etendue::scene
