// KHR_materials_variants: the names, and which material a primitive wears in each.
#include "scene/gltf/import.h"

namespace etendue::scene::gltf {
namespace {

constexpr const char* kVariants = "KHR_materials_variants";

}  // namespace

void import_variants(const Document& document, Scene& scene) {
  const auto* extension = extension_of(document.model.extensions, kVariants);
  if (!extension) return;
  const auto& variants = extension->Get("variants");
  for (size_t v = 0; v < variants.ArrayLen(); ++v) {
    const auto& name = variants.Get(v).Get("name");
    scene.variants.push_back(name.IsString() ? name.Get<std::string>() : "");
  }
}

std::vector<int> material_choices(const Document& document, const Scene& scene, const tinygltf::Primitive& primitive,
                                  int own, const std::string& where) {
  const auto* extension = extension_of(primitive.extensions, kVariants);
  if (!extension) return {};
  std::vector<int> choices(scene.variants.size() + 1, own);
  const auto& mappings = extension->Get("mappings");
  for (size_t m = 0; m < mappings.ArrayLen(); ++m) {
    const auto& mapping = mappings.Get(m);
    const std::string at_mapping = where + ".extensions." + kVariants + "." + at("mappings", m);
    const auto material = checked_index(index_of(mapping, "material", -1), document.model.materials.size(),
                                        at_mapping + ".material", "materials");
    const auto& variants = mapping.Get("variants");
    for (size_t v = 0; v < variants.ArrayLen(); ++v)
      choices[1 + checked_index(variants.Get(v).GetNumberAsInt(), scene.variants.size(),
                                at_mapping + "." + at("variants", v), "variants")] = static_cast<int>(material);
  }
  return choices;
}

}  // namespace etendue::scene::gltf
