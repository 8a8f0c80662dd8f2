// Forward declarations of the types of scenes.
#pragma once

namespace etendue::scene {

struct Scene;
struct SurfacePoint;
class CompiledScene;

}  // namespace etendue::scene
