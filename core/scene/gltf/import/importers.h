// The parts of the importer. Each converts one kind of object of a checked file into a part of the Scene.
//
// Order: materials and variants first, because they decide which attributes a mesh needs; then lights, cameras, nodes,
// skins and animations; meshes and images last, because they take the longest and run in parallel.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf/import/input_file.h"
#include "scene/scene.h"

namespace etendue::scene::gltf {

// Textures (without images) and materials. The default material is appended as the last one.
void import_materials(const InputFile& input, Scene& scene);
void import_lights(const InputFile& input, Scene& scene);
void import_cameras(const InputFile& input, Scene& scene);
// Nodes, and the roots of a scene of the file; -1 is the default scene.
void import_nodes(const InputFile& input, Scene& scene, int scene_index);
// EXT_mesh_gpu_instancing: appends one node per instance.
void import_instances(const InputFile& input, Scene& scene);
void import_skins(const InputFile& input, Scene& scene);
void import_animations(const InputFile& input, Scene& scene);

// The names of the variants.
void import_variants(const InputFile& input, Scene& scene);
// Primitive::choices, where `material` is the material without a variant.
std::vector<int> variant_materials(const InputFile& input, const Scene& scene, const tinygltf::Primitive& primitive,
                                   int material, const std::string& where);

// ETENDUE_transport of the root: time, variant, environment and atmosphere.
void import_transport(const InputFile& input, Scene& scene);
// KHR_materials_volume_scatter: divides the attenuation of KHR_materials_volume into scattering and absorption.
void import_volume_scatter(const tinygltf::ExtensionMap& extensions, const std::string& where, Material& material,
                           std::vector<std::string>& warnings);
// ETENDUE_transport of a material: the medium inside it.
void import_medium(const InputFile& input, const tinygltf::ExtensionMap& extensions, const std::string& where,
                   Material& material, std::vector<std::string>& warnings);
// ETENDUE_transport of the root: the atmosphere.
Atmosphere import_atmosphere(const InputFile& input, const tinygltf::Value& extension, const std::string& where,
                             std::vector<std::string>& warnings);
// ETENDUE_transport of a material: its reflection model; null if it has none or the name is unknown.
BsdfModelRef import_bsdf_model(const tinygltf::ExtensionMap& extensions, const std::string& where,
                               std::vector<std::string>& warnings);
// ETENDUE_transport of a material: the glass whose index of refraction it has.
Glass import_glass(const tinygltf::ExtensionMap& extensions, const std::string& where,
                   std::vector<std::string>& warnings);
// ETENDUE_transport of a material: the spectrum of its emission.
EmissionSpectrumRef import_emission_spectrum(const InputFile& input, const tinygltf::ExtensionMap& extensions,
                                             const std::string& where, std::vector<std::string>& warnings);
Layering import_layering(const tinygltf::ExtensionMap& extensions, const std::string& where,
                         std::vector<std::string>& warnings);
// ETENDUE_transport of a light: properties that KHR_lights_punctual does not have.
void import_light_extension(const InputFile& input, const tinygltf::ExtensionMap& extensions, const std::string& where,
                            Light& light, std::vector<std::string>& warnings);
// ETENDUE_transport of a node: the size of its environment portal, 0 without one.
Vec2 import_portal(const tinygltf::ExtensionMap& extensions, const std::string& where,
                   std::vector<std::string>& warnings);
// ETENDUE_transport of a camera: lens and shutter.
void import_camera_extension(const tinygltf::ExtensionMap& extensions, const std::string& where, Camera& camera,
                             std::vector<std::string>& warnings);

// One mesh to read. Primitives with the same vertices and triangles share it.
struct MeshTask {
  struct User {  // a primitive that shows the mesh
    size_t mesh, primitive;
    int material;
    std::vector<int> choices;  // Primitive::choices
  };
  const tinygltf::Primitive* primitive = nullptr;
  const Material* material = nullptr;  // of all materials of the users, one that needs tangents if there is one
  std::string where;
  bool shares_vertices = false;  // with primitives that have other triangles
  std::vector<User> users;

  std::shared_ptr<const Mesh> mesh;  // the result; null if there is nothing to render
  std::shared_ptr<const Deformation> deformation;
  std::vector<std::string> warnings;
};
std::vector<MeshTask> mesh_tasks(const InputFile& input, const Scene& scene);
void read_mesh(const InputFile& input, MeshTask& task);
void add_meshes(const InputFile& input, const std::vector<MeshTask>& tasks, Scene& scene);

// Call after all nodes and meshes are in the scene. Removes the meshes of nodes that would place them beyond
// kFarthestPosition, with a warning.
void remove_far_meshes(Scene& scene);

// Call after all materials and meshes are in the scene. Warns of meshes that bound a scattering, emitting or
// heterogeneous medium and are not closed.
void check_boundaries(Scene& scene);

// One image to decode. Images that no texture uses have no task.
struct ImageTask {
  size_t image = 0;
  bool srgb = false;  // read as colours by a material

  // The result: one of them, or none if the image cannot be decoded.
  std::shared_ptr<const image::Image> pixels = nullptr;
  std::shared_ptr<const image::TiledImage> tiles = nullptr;
  std::string warning = {};
};
std::vector<ImageTask> image_tasks(const InputFile& input, const Scene& scene);
// Whether the decoded images need more memory than the budget (image/texture_memory.h).
bool exceed_texture_memory(const InputFile& input, const std::vector<ImageTask>& tasks);
// Decodes the image, or opens its tiles if `tiled`.
void read_image_task(const InputFile& input, bool tiled, ImageTask& task);
void add_images(const InputFile& input, const std::vector<ImageTask>& tasks, Scene& scene);

// Morph targets and joint weights of a primitive; null if it has neither. `selection` is empty if all vertices are
// used.
std::shared_ptr<Deformation> read_deformation(const InputFile& input, const MeshTask& task,
                                              const std::vector<uint32_t>& selection, size_t vertices,
                                              std::vector<std::string>& warnings);
// Applies a new vertex order: vertex i becomes a copy of the old vertex sources[i].
void reorder_vertices(Deformation& deformation, const std::vector<uint32_t>& sources, size_t old_vertices);

// A member of a JSON value; a null value if there is none or the value is not an object.
const tinygltf::Value& member_of(const tinygltf::Value& value, const char* name);
// Members of JSON objects; `fallback` if they are missing or have another type.
const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const char* name);
float number_or(const tinygltf::Value& object, const char* member, float fallback);
int index_or(const tinygltf::Value& object, const char* member, int fallback);
// The member if it is a number in [low, high]; nothing otherwise, with a warning that begins with `where`.
std::optional<float> number_in_range(const tinygltf::Value& object, const char* member, float low, float high,
                                     const std::string& where, std::vector<std::string>& warnings);
// The value of a parameter; an empty text for other types.
Value value_of(const tinygltf::Value& value);
Rgb color_or(const tinygltf::Value& object, const char* member, const Rgb& fallback);

}  // namespace etendue::scene::gltf
