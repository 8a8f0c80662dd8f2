// Places of the nodes of a scene, and which of them exist. Computed once for each scene, because the interface needs it
// in every frame and large scenes have a million nodes.
#pragma once
#include <memory>
#include <vector>

#include "base/vec.h"
#include "scene/forward.h"

namespace etendue::viewer {

class NodePlaces {
 public:
  struct Places {
    std::vector<Mat4> world;     // of all nodes
    std::vector<bool> exists;    // for each node, whether it was not removed
    std::vector<int> lights;     // nodes with a light that exist
    std::vector<int> with_icon;  // nodes with a light or a camera that exist
  };
  const Places& of(const std::shared_ptr<const scene::Scene>& scene) const;

 private:
  mutable std::shared_ptr<const scene::Scene> scene_;
  mutable Places places_;
};

}  // namespace etendue::viewer
