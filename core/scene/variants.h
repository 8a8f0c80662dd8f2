// Material variants: alternative materials for the same meshes.                                 KHR_materials_variants
#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"

namespace etendue::scene {

// Selects a variant; -1 selects the materials that the file uses without a variant.
void select_variant(Scene& scene, int variant);

// Selects a variant and removes all variants from the scene.
void keep_only_variant(Scene& scene, int variant);

// The names of the selectable variants; the first stands for none. All names are unique.
std::vector<std::string> variant_labels(const Scene& scene);

}  // namespace etendue::scene
