// Where everything is while the shutter is open.                                           thesis 8.3.4, (8.61); S13
//
// Animations may move along any curve. They are looked at closely enough to see every key, and cut into as few straight
// pieces as stay within a part of the thing's own size, so that a wheel stays round.
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
  // Open for `seconds` from the scene's time on; 0 is never open.
  Shutter(const Scene& scene, float seconds);

  // A primitive that moves: its mesh, in world space at the opening if it deforms, and how it goes on. Nothing if it
  // stands still, or is flat all the time.
  struct Moving {
    std::shared_ptr<const Mesh> mesh;
    std::shared_ptr<const Motion> motion;
  };
  std::optional<Moving> moving(int node, const Primitive& primitive);

  // How a node without a mesh moves; null if it stands still.
  std::shared_ptr<const Motion> motion_of(int node);

  // How a camera moves along with its node; null if it stands still or belongs to none.
  std::shared_ptr<const CameraMotion> motion_of(const Camera& camera);

 private:
  static constexpr int kSegments = static_cast<int>(Motion::kMostSteps) - 1;  // the finest cut

  float time(int moment) const;
  const std::vector<Mat4>& world(int moment);
  Mat4 world(int moment, int node) { return world(moment)[static_cast<size_t>(node)]; }
  void find_animated();
  int resolution_for(float span) const;
  bool is_animated(int node) const;
  bool changes_shape(int node, const Primitive& primitive) const;
  bool stands_still(int node);
  int times_flat(int node);
  Moving rigid(int node, std::shared_ptr<const Mesh> mesh);
  std::optional<Moving> deforming(int node, const Primitive& primitive);
  std::shared_ptr<const Mesh> mesh_at(int moment, int node, const Primitive& primitive);
  template <class Deviation>
  int segments_for(int most, Deviation&& deviation) const;

  const Scene& scene_;
  float seconds_;
  std::vector<bool> moving_;    // nodes that are moved, by themselves or by a parent; empty if nothing is animated
  std::vector<bool> morphing_;  // nodes whose morph weights change
  int resolution_ = 8;          // moments to look at, a power of two
  std::map<int, std::vector<Mat4>> worlds_;  // by moment, of kSegments
};

}  // namespace etendue::scene
