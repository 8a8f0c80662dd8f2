// The acceleration structures of meshes while a scene is compiled: those of the previous scene and new ones.
#pragma once
#include <memory>
#include <unordered_map>
#include <vector>

#include "geometry/accel.h"

namespace etendue::scene {

class MeshAccels {
 public:
  using List = std::vector<std::shared_ptr<const MeshAccel>>;

  explicit MeshAccels(const List& previous) {
    for (const auto& accel : previous) known_[accel->mesh().get()] = {.accel = accel, .from_before = true};
  }

  // Whether the previous scene has the structure of this mesh.
  bool is_from_before(const Mesh& mesh) const {
    const auto found = known_.find(&mesh);
    return found != known_.end() && found->second.from_before;
  }

  // Builds the structure if there is none.
  const std::shared_ptr<const MeshAccel>& get(const std::shared_ptr<const Mesh>& mesh) {
    Known& known = known_[mesh.get()];
    if (!known.accel) known.accel = std::make_shared<MeshAccel>(mesh), ++built_;
    if (known.from_before) ++reused_;
    known.is_used = true;
    return known.accel;
  }

  int built() const { return built_; }
  int reused() const { return reused_; }  // calls of get() that returned a structure of the previous scene
  List used() const { return list(true); }
  List all() const { return list(false); }

 private:
  struct Known {
    std::shared_ptr<const MeshAccel> accel;
    bool from_before = false, is_used = false;
  };

  List list(bool only_used) const {
    List list;
    for (const auto& [_, known] : known_)
      if (known.is_used || !only_used) list.push_back(known.accel);
    return list;
  }

  std::unordered_map<const Mesh*, Known> known_;
  int built_ = 0, reused_ = 0;
};

}  // namespace etendue::scene
