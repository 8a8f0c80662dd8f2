// The edits of materials and textures among the structural edits (scene/structural_edit.h).
#pragma once
#include "scene/structural_edit.h"

namespace etendue::scene {

// A diffuse material with an albedo of 0.7.
Material new_material(const std::string& name);

// The scene after an edit of materials or textures. The node of an assignment must exist.
Result<Scene> with_material_edit(Scene scene, const StructuralEdit& edit);

}  // namespace etendue::scene
