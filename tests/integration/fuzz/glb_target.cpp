// GLB files: bytes of the container and of the binary chunk are mutated. One of eight inputs is also rendered.
#include "integration/fuzz/gltf_run.h"
#include "integration/fuzz/gltf_seeds.h"

namespace etendue::fuzz {

const Target kTarget{.run = open_and_render, .seeds = gltf_seeds};

}  // namespace etendue::fuzz
