// Small glTF files that use many features.
#pragma once
#include "integration/fuzz/mutation.h"

namespace etendue::fuzz {

// GLBs: an indexed and textured square with most material extensions, morph targets, a skin, an animation, cameras and
// lights; instances; sparse accessors; quantised attributes.
std::vector<Bytes> gltf_seeds();

}  // namespace etendue::fuzz
