// Positions of nodes, meshes and cameras at a given time.
#pragma once
#include <memory>
#include <vector>

#include "scene/scene.h"

namespace etendue::scene {

// Whether the linear part of the matrix is not invertible in single precision, or its inverse has elements above 1e8.
// Meshes with such a world matrix are not rendered.
bool is_singular(const Mat4& m);

// The nodes, of those that a root reaches, whose world matrix at the scene's time is out of range
// (scene/coordinate_range.h). Descendants of such a node are not listed.
std::vector<int> nodes_out_of_range(const Scene& scene);

// Indices of the animations that play together. Each animation plays unless it animates the same property of a node as
// an earlier one: files hold either parts of one movement, or alternative movements of the same nodes. If the scene
// names a clip, it plays alone.
std::vector<size_t> playing_animations(const Scene& scene);

// World matrices at `time` seconds on the clock of the animations; otherwise like world_matrices(scene).
std::vector<Mat4> world_matrices(const Scene& scene, float time);

// Whether the joints of a skin place the primitive. The matrix of its node has no effect then.
bool is_skinned(const Scene& scene, int node, const Primitive& primitive);

// A copy of the mesh of a primitive with a deformation, morphed and skinned: in the space of the node, or in world
// space if it is skinned.
std::shared_ptr<Mesh> deformed_mesh(const Scene& scene, int node, const Primitive& primitive,
                                    const std::vector<Mat4>& world, float time);

// The mesh transformed to world space; the same mesh if `to_world` is the identity.
std::shared_ptr<const Mesh> in_world(const std::shared_ptr<const Mesh>& mesh, const Mat4& to_world);

// Camera::to_world for the world matrix of a camera's node: scale is removed.
Mat4 camera_to_world(const Mat4& node);

// The node of a camera; -1 if the camera was moved away from it.
int node_of_camera(const Scene& scene, const Camera& camera);

// Whether a channel changes the transform of a node.
inline bool is_transform_channel(const AnimationChannel& channel, int node) {
  return channel.node == node && channel.path != AnimatedPath::weights;
}
// Whether an animation that plays does.
bool has_animated_transform(const Scene& scene, int node);
// The transform of a node at the scene's time, with animations applied.
Transform posed_transform(const Scene& scene, int node);

// Calls apply(channel) for all channels of the playing animations.
template <class Apply>
void for_each_channel(const Scene& scene, Apply&& apply) {
  for (const size_t animation : playing_animations(scene))
    for (const AnimationChannel& channel : scene.animations[animation]->channels) {
      const bool is_valid =
          channel.node >= 0 && static_cast<size_t>(channel.node) < scene.nodes.size() && !channel.times.empty();
      if (is_valid) apply(channel);
    }
}

}  // namespace etendue::scene
