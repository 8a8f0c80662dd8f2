// The parameters of a material by name, apart from the scene: to copy a material, and to keep it in a file.
//
// A material file (.material) is JSON text: the name of the material, its parameters that differ from those of a new
// glTF surface, and the images of its textures, which are PNG files beside it.
#pragma once
#include <string>
#include <vector>

#include "base/parameter.h"
#include "base/result.h"
#include "render/document.h"

namespace etendue::render {

inline constexpr const char* kMaterialExtension = ".material";

// All parameters of a material, without "material.N.". Textures are indices into `textures`.
std::vector<Setting> material_settings(const Material& material, const std::vector<Texture>& textures);
// The material with these parameters; those that are not listed have the values of a new glTF surface. The name stays.
// An error if a parameter is unknown or out of range.
Result<Material> with_material_settings(const Material& material, const std::vector<Texture>& textures,
                                        const std::vector<Setting>& settings);

// The document with other parameters of one material, except for its name.
Result<Document> with_material_settings(const Document& document, size_t material,
                                        const std::vector<Setting>& settings);

// Writes a material of a scene, and its textures, replacing existing files. Floating-point textures are clamped to
// [0, 1].
Result<void> write_material_file(const std::string& file, const scene::Scene& scene, size_t material);

struct MaterialFile {
  std::string name;
  std::vector<Setting> settings{};  // without textures
  struct TextureFile {
    std::string slot;  // material/texture_slots.h
    std::string file;
    scene::DecodedImage image{};
  };
  std::vector<TextureFile> textures{};
};
// Without the images of textures.
Result<MaterialFile> read_material_file(const std::string& file);
// With them.
Result<MaterialFile> read_material_with_textures(const std::string& file);

// The document in which the material has the parameters and textures of a file; images that were not read are. Textures
// are added to the scene. `file` is its name in messages.
Result<Document> with_material(const Document& document, size_t material, const MaterialFile& content,
                               const std::string& file);
Result<Document> with_material_file(const Document& document, size_t material, const std::string& file);

}  // namespace etendue::render
