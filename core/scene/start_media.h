// The solids around the camera and around each light: where paths begin.
//
// They are found at compile time where that decides it for every point and time. What is left is found for each path:
// points of a light whose bounds a boundary passes through, a camera with a lens or a near plane, anything that moves.
#pragma once
#include <vector>

#include "camera/camera.h"
#include "geometry/ray.h"
#include "light/sampling/light_table.h"
#include "scene/solids.h"

namespace etendue::scene {

struct SurfacePoint;

class StartMedia {
 public:
  StartMedia() = default;
  // `same_lights` is one whose lights and solids are the same, or null.
  StartMedia(const Solids& solids, const std::vector<InstanceData>& instances, const LightTable& lights,
             const Camera& camera, bool camera_moves, const StartMedia* same_lights);

  MediumStack at_camera(const Solids& solids, const std::vector<InstanceData>& instances, const Ray& ray,
                        float time) const;
  void find_at_light(const Solids& solids, const std::vector<InstanceData>& instances, const LightTable& lights,
                     const Emission& emission, const SurfacePoint* point, const Vec3& origin,
                     MediumInterface& found) const;

 private:
  // One set for every point of something, or a set for each of them.
  struct Surroundings {
    bool varies = false;
    MediumStack stack;  // where they do not vary
  };

  void find_lights(const Solids& solids, const std::vector<InstanceData>& instances, const LightTable& lights);
  void find_camera(const Solids& solids, const std::vector<InstanceData>& instances, const Camera& camera,
                   bool camera_moves);

  std::vector<Surroundings> emitters_;  // by instance; empty where all are outside of every solid
  std::vector<Surroundings> placed_;    // by placed light; the same
  Surroundings camera_;
};

}  // namespace etendue::scene
