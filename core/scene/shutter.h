// The motion of nodes, meshes and cameras while the shutter is open.                  [Lang, sec. 8.4.3.3, eq. 8.61]
//
// Animations move along arbitrary curves. They are sampled finely enough to resolve every keyframe. Each motion is then
// approximated by the smallest number of linear segments whose deviation stays below a fraction of the object's size,
// so that a rotating wheel remains round.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "camera/camera_motion.h"
#include "geometry/motion.h"
#include "scene/scene.h"

namespace etendue::scene {

class Shutter {
 public:
  // The shutter opens at the scene's time for `seconds`; 0 is an instant.
  Shutter(const Scene& scene, float seconds);

  // Whether any node is animated while the shutter is open.
  bool sees_motion() const { return !moving_.empty(); }

  // The mesh of a moving primitive and its motion. A mesh that deforms is in world space at the time of opening.
  // Nothing if the primitive does not move, or if its world matrix is singular at all times.
  struct Moving {
    std::shared_ptr<const Mesh> mesh;
    std::shared_ptr<const Motion> motion;
  };
  std::optional<Moving> moving(int node, const Primitive& primitive);

  // The motion of a node without a mesh; null if it does not move.
  std::shared_ptr<const Motion> motion_of(int node);

  // The motion of a camera with its node; null if it does not move or has no node.
  std::shared_ptr<const CameraMotion> motion_of(const Camera& camera);

 private:
  static constexpr int kSegments = static_cast<int>(Motion::kMaxSteps) - 1;  // largest number of segments

  // A moment is an integer in [0, kSegments]: a fraction of the time that the shutter is open.
  float time(int moment) const;
  const std::vector<Mat4>& world(int moment);
  Mat4 world(int moment, int node) { return world(moment)[static_cast<size_t>(node)]; }
  void find_animated();
  int resolution_for(float span) const;
  bool is_animated(int node) const;
  bool changes_shape(int node, const Primitive& primitive) const;
  bool is_static(int node);
  int count_singular(int node);
  Moving rigid(int node, std::shared_ptr<const Mesh> mesh);
  std::optional<Moving> deforming(int node, const Primitive& primitive);
  std::shared_ptr<const Mesh> mesh_at(int moment, int node, const Primitive& primitive);
  template <class IsLinear>
  int segments_for(int limit, IsLinear&& is_linear) const;

  const Scene& scene_;
  float seconds_;
  std::vector<bool> moving_;    // nodes with an animated transform or ancestor; empty if nothing is animated
  std::vector<bool> morphing_;  // nodes whose morph weights change
  int resolution_ = 8;          // sampling intervals of the open shutter, a power of two
  std::map<int, std::vector<Mat4>> worlds_;  // by moment
};

}  // namespace etendue::scene
