// Names of the scene's types, for headers that only refer to them.
#pragma once

namespace etendue::scene {

struct Scene;
struct SurfacePoint;
class CompiledScene;

}  // namespace etendue::scene
