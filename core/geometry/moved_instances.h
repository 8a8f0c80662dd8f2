// The structure over the instances that have moved since a TopLevel was built; part of Accel.
#pragma once
#include <embree3/rtcore.h>

#include <vector>

#include "geometry/accel_instance.h"
#include "geometry/mesh.h"

namespace etendue {

class MovedInstances {
 public:
  // Of `instances` in all.
  MovedInstances(std::vector<MovedInstance> moved, size_t instances);
  ~MovedInstances();
  MovedInstances(const MovedInstances&) = delete;
  MovedInstances& operator=(const MovedInstances&) = delete;

  // Geometry ids are indices into list().
  RTCScene scene() const { return scene_; }
  const Bounds& bounds() const { return bounds_; }
  const std::vector<MovedInstance>& list() const { return moved_; }

  // Whether rays ignore this instance in the top level, because it is in the list.
  bool is_hidden(uint32_t instance) const { return is_hidden_[instance]; }

 private:
  RTCScene scene_;
  std::vector<MovedInstance> moved_;
  Bounds bounds_;
  std::vector<bool> is_hidden_;  // by instance
};

}  // namespace etendue
