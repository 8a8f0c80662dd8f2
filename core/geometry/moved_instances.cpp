#include "geometry/moved_instances.h"

#include "geometry/cylinder_geometry.h"
#include "geometry/embree_scene.h"
#include "geometry/mesh_accel.h"

namespace etendue {

MovedInstances::MovedInstances(std::vector<MovedInstance> moved, size_t instances)
    : scene_(new_embree_scene()), moved_(std::move(moved)), is_hidden_(instances) {
  for (uint32_t i = 0; i < moved_.size(); ++i) {
    attach(scene_, instance_geometry(moved_[i].accel->scene(), moved_[i].to_world), i);
    is_hidden_[moved_[i].number] = true;
  }
  commit_scene(scene_);
  bounds_ = bounds_of(scene_);
}

MovedInstances::~MovedInstances() { rtcReleaseScene(scene_); }

}  // namespace etendue
