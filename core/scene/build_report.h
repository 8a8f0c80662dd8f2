// What compiling a scene rebuilt and what it reused.
#pragma once

namespace etendue::scene {

struct BuildReport {
  int meshes_built = 0, meshes_reused = 0;
  int instances_moved = 0;  // without a new top level
  bool top_level_built = false, lights_built = false, materials_built = false;
  double seconds = 0;
};

}  // namespace etendue::scene
