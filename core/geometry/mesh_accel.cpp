#include "geometry/mesh_accel.h"

#include "geometry/embree_scene.h"

namespace etendue {

MeshAccel::MeshAccel(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)), scene_(new_embree_scene()) {
  attach(scene_, triangle_geometry(*mesh_), 0);
  rtcCommitScene(scene_);
}

MeshAccel::~MeshAccel() { rtcReleaseScene(scene_); }

}  // namespace etendue
