#include "scene/variants.h"

#include <algorithm>

namespace etendue::scene {

void select_variant(Scene& scene, int variant) {
  scene.variant = variant;
  for (MeshGroup& group : scene.meshes)
    for (Primitive& primitive : group.primitives)
      if (!primitive.choices.empty()) primitive.material = primitive.choices[static_cast<size_t>(variant + 1)];
}

void keep_only_variant(Scene& scene, int variant) {
  select_variant(scene, variant);
  for (MeshGroup& group : scene.meshes)
    for (Primitive& primitive : group.primitives) primitive.choices.clear();
  scene.variants.clear();
  scene.variant = -1;
}

std::vector<std::string> variant_labels(const Scene& scene) {
  std::vector<std::string> choices{"file's own"};
  for (const std::string& name : scene.variants) {
    std::string choice = name.empty() ? "variant" : name;
    for (int n = 2; std::ranges::count(choices, choice) > 0; ++n)
      choice = (name.empty() ? "variant" : name) + " " + std::to_string(n);
    choices.push_back(std::move(choice));
  }
  return choices;
}

}  // namespace etendue::scene
