// Variants: one set of meshes, several sets of materials to choose from.                        KHR_materials_variants
#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"

namespace etendue::scene {

// Shows variant `variant`, or with -1 the materials that the file itself gives.
void select_variant(Scene& scene, int variant);

// Shows it and forgets the others: it becomes the scene's only look.
void keep_only_variant(Scene& scene, int variant);

// What the variants are called where one is chosen; the first is the file's own. No two are the same.
std::vector<std::string> variant_labels(const Scene& scene);

}  // namespace etendue::scene
