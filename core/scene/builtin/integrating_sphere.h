// An integrating sphere: a diffuse sphere seen from inside with an emitting cap. Mean and variance are known in closed
// form for many integrators.
//
// The geometry term between any two points of a sphere of radius R is 1/(4 R^2), so the vertices of a path are
// independent and uniform on the sphere. Let the cap have the fraction a of the area and radiance 1, and let the whole
// sphere have the albedo rho. The second column holds for a black cap.
//
//   reflected radiance              m = rho a / (1 - rho)                 m = rho a / (1 - rho (1 - a))
//   variance of one path that       a (1 - a) rho^2 / (1 - rho^2)         rho^2 a / (1 - rho^2 (1 - a)) - m^2
//     finds light by hits alone
//   contribution of paths with      a rho^(k-1)
//     k >= 2 edges
//
// The sphere is a triangle mesh. Triangles deviate from the sphere by at most 1e-4 of the radius, the area of the cap
// by at most 1e-4 of its value, and radiance by about as much. Quantities that are constant on a sphere have a relative
// variance of 5e-5.
#pragma once
#include "scene/scene.h"

namespace etendue::scene {

// Whether the emitting cap reflects like the rest of the sphere.
enum class Cap { reflecting, black };

// Radius 1, centred at the origin, cap at +y. The fraction of the area is in (0, 1/2].
Scene integrating_sphere(double fraction, float albedo, Cap cap = Cap::reflecting);

// At the centre of the sphere, looking away from the cap.
Camera integrating_sphere_camera();

}  // namespace etendue::scene
