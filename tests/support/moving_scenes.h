// Animated scenes, for tests of the shutter.
#pragma once
#include <vector>

#include "support/scenes.h"

namespace etendue::test {

// Animates a property of a node by linear interpolation between keys (spherical for rotations). The node must not have
// a matrix, because the animation replaces its transform.
void animate(scene::Scene& scene, int node, scene::AnimatedPath path, std::vector<float> seconds,
             std::vector<float> values);

// Rotation about an axis as a quaternion (x, y, z, w).
Vec4 turn(const Vec3& axis, float radians);

// Adds a camera to the scene and returns its node.
int add_camera(scene::Scene& scene, const Camera& camera);

// A square document seen through the first camera of the scene.
render::Document from_scene_camera(scene::Scene scene, int size);

// A glazed ball that swings, a cube that rotates and a light that passes over a floor. The camera moves as well and is
// out of focus. Covers everything that depends on the time of a path and on the lens sample. The shutter is open for
// one second.
render::Document motion_and_lens_scene();

}  // namespace etendue::test
