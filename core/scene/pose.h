// What posing and importing have to agree on.
#pragma once
#include <memory>
#include <vector>

#include "scene/scene.h"

namespace etendue::scene {

// The matrix flattens space, or shrinks it beyond what single precision can undo: nothing placed by it has a surface.
bool is_singular(const Mat4& m);

// The animations that play together, in order: each that animates nothing which an earlier one does. Files hold either
// the parts of one movement (all play) or a choice of movements for the same nodes (the first plays).
std::vector<size_t> playing_animations(const Scene& scene);

// World matrices at any time, in seconds on the clock of the animations.
std::vector<Mat4> world_matrices(const Scene& scene, float time);

// Joints of a skin move the primitive, not the node that shows it.
bool is_skinned(const Scene& scene, int node, const Primitive& primitive);

// A copy of the primitive's mesh, morphed and skinned, whatever its node's matrix: in the node's space, or in world
// space if it is skinned. Of a primitive with a deformation.
std::shared_ptr<Mesh> deformed_mesh(const Scene& scene, int node, const Primitive& primitive,
                                    const std::vector<Mat4>& world, float time);

// The mesh moved to world space; itself if it is there.
std::shared_ptr<const Mesh> in_world(const std::shared_ptr<const Mesh>& mesh, const Mat4& to_world);

// Camera::to_world of a camera whose node has this matrix: scale does not belong to a camera.
Mat4 camera_to_world(const Mat4& node);

// The node that a camera belongs to, or -1: one that was moved away from its node belongs to none.
int node_of_camera(const Scene& scene, const Camera& camera);

// Calls apply(channel) for every channel that plays.
template <class Apply>
void for_each_channel(const Scene& scene, Apply&& apply) {
  for (const size_t animation : playing_animations(scene))
    for (const AnimationChannel& channel : scene.animations[animation]->channels) {
      const bool usable =
          channel.node >= 0 && static_cast<size_t>(channel.node) < scene.nodes.size() && !channel.times.empty();
      if (usable) apply(channel);
    }
}

}  // namespace etendue::scene
