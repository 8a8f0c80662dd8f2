// Imports KHR_materials_variants: the names of the variants, and the material of each primitive in each variant.
#include "scene/gltf/import/importers.h"

namespace etendue::scene::gltf {
namespace {

constexpr const char* kVariants = "KHR_materials_variants";

}  // namespace

void import_variants(const InputFile& input, Scene& scene) {
  const auto* extension = find_extension(input.model.extensions, kVariants);
  if (!extension) return;
  const auto& variants = extension->Get("variants");
  for (size_t v = 0; v < variants.ArrayLen(); ++v) {
    const auto& name = member_of(variants.Get(v), "name");
    scene.variants.push_back(name.IsString() ? name.Get<std::string>() : "");
  }
}

std::vector<int> variant_materials(const InputFile& input, const Scene& scene, const tinygltf::Primitive& primitive,
                                   int material, const std::string& where) {
  const auto* extension = find_extension(primitive.extensions, kVariants);
  if (!extension) return {};
  std::vector<int> choices(scene.variants.size() + 1, material);
  const auto& mappings = extension->Get("mappings");
  for (size_t m = 0; m < mappings.ArrayLen(); ++m) {
    const auto& mapping = mappings.Get(m);
    const std::string at_mapping = where + ".extensions." + kVariants + "." + at("mappings", m);
    const auto mapped = checked_index(index_or(mapping, "material", -1), input.model.materials.size(),
                                      at_mapping + ".material", "materials");
    const auto& variants = member_of(mapping, "variants");
    for (size_t v = 0; v < variants.ArrayLen(); ++v)
      choices[1 + checked_index(variants.Get(v).GetNumberAsInt(), scene.variants.size(),
                                at_mapping + "." + at("variants", v), "variants")] = static_cast<int>(mapped);
  }
  return choices;
}

}  // namespace etendue::scene::gltf
