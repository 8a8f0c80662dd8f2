// The solids that contain the camera and the lights, where paths start.
//
// They are precomputed if they are the same for all points and times. Otherwise they are found for each path: on lights
// whose bounds a boundary intersects, for cameras with a near plane or with a lens that a boundary may intersect, and
// for everything that moves.
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
  // `same_lights` is a table for the same lights and solids, or null.
  StartMedia(const Solids& solids, const InstanceArray& instances, const LightTable& lights, const Camera& camera,
             bool camera_moves, const StartMedia* same_lights);

  MediumStack at_camera(const Solids& solids, const InstanceArray& instances, const Ray& ray, float time) const;
  void find_at_light(const Solids& solids, const InstanceArray& instances, const LightTable& lights,
                     const Emission& emission, const SurfacePoint* point, const Vec3& origin,
                     MediumInterface& found) const;

 private:
  // The solids around a light or the camera.
  struct Surroundings {
    bool varies = false;  // depend on the point or the time
    MediumStack stack;    // if they do not vary
  };

  void find_lights(const Solids& solids, const InstanceArray& instances, const LightTable& lights);
  void find_camera(const Solids& solids, const InstanceArray& instances, const Camera& camera, bool camera_moves);

  std::vector<Surroundings> emitters_;  // by instance; empty without solids
  std::vector<Surroundings> placed_;    // by placed light; empty without solids
  Surroundings camera_;
};

}  // namespace etendue::scene
