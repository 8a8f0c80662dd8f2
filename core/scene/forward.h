// Forward declarations of the types of scenes.
#pragma once
#include "base/shared_array.h"

namespace etendue::scene {

struct Scene;
struct InstanceData;
struct SurfacePoint;
class CompiledScene;
using InstanceArray = SharedArray<InstanceData>;

}  // namespace etendue::scene
