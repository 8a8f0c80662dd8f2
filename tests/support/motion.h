// Scenes that move, for what depends on the shutter.
#pragma once
#include <vector>

#include "support/scenes.h"

namespace etendue::test {

// Animates a property of a node by straight lines (rotations: arcs) between keys. The node must not have a matrix:
// what is animated replaces it.
void animate(scene::Scene& scene, int node, scene::AnimatedPath path, std::vector<float> seconds,
             std::vector<float> values);

// A turn about an axis as the four numbers of a rotation.
Vec4 turn(const Vec3& axis, float radians);

// Puts a camera into the scene; returns its node.
int add_camera(scene::Scene& scene, const Camera& camera);

// As seen through the scene's first camera, with a square picture.
render::Document through_its_camera(scene::Scene scene, int size);

// A glazed ball that swings, a cube that turns and a lamp that passes by over a floor, seen out of focus by a camera on
// the move: everything that a path's time and a point of the lens decide. The shutter is open for a second.
render::Document lens_and_shutter();

}  // namespace etendue::test
