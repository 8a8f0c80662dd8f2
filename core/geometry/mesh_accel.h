// The acceleration structure of one mesh.
#pragma once
#include <embree3/rtcore.h>

#include <memory>

#include "geometry/mesh.h"

namespace etendue {

class MeshAccel {
 public:
  explicit MeshAccel(std::shared_ptr<const Mesh> mesh);
  ~MeshAccel();
  MeshAccel(const MeshAccel&) = delete;
  MeshAccel& operator=(const MeshAccel&) = delete;

  RTCScene scene() const { return scene_; }
  const std::shared_ptr<const Mesh>& mesh() const { return mesh_; }

 private:
  std::shared_ptr<const Mesh> mesh_;
  RTCScene scene_;
};

}  // namespace etendue
