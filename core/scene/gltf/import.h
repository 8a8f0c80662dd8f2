// The parts of a scene, each made from a validated document. Textures first, the light things before nodes, meshes and
// pictures last: materials say what a mesh needs.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "scene/gltf/document.h"
#include "scene/scene.h"

namespace etendue::scene::gltf {

// Textures and materials; the pictures come later, and the default material stands at the end.
void import_materials(const Document& document, Scene& scene);
void import_lights(const Document& document, Scene& scene);
void import_cameras(const Document& document, Scene& scene);
// Nodes, and the roots of the wanted scene (-1: of the file's own choice).
void import_nodes(const Document& document, Scene& scene, int wanted_scene);
// The nodes of instances, after all others.
void import_instances(const Document& document, Scene& scene);
void import_skins(const Document& document, Scene& scene);
void import_animations(const Document& document, Scene& scene);

// The names of the variants, and Primitive::choices where `own` is what the primitive wears without one.
void import_variants(const Document& document, Scene& scene);
std::vector<int> material_choices(const Document& document, const Scene& scene, const tinygltf::Primitive& primitive,
                                  int own, const std::string& where);

// ETENDUE_transport: the time, the variant and the environment of the whole scene; what belongs to one of its things.
void import_transport(const Document& document, Scene& scene);
// The reflection model of a material; none if there is none, or none of that name.
BsdfModelRef import_reflection(const tinygltf::ExtensionMap& extensions, const std::string& where,
                               std::vector<std::string>& warnings);
// What KHR_lights_punctual does not know of a light.
void import_shape(const tinygltf::ExtensionMap& extensions, const std::string& where, Light& light,
                  std::vector<std::string>& warnings);
void import_lens(const tinygltf::ExtensionMap& extensions, const std::string& where, Camera& camera,
                 std::vector<std::string>& warnings);

// One mesh to read. Primitives that would make the same one share it.
struct MeshTask {
  struct User {
    size_t mesh, primitive;
    int material;
    std::vector<int> choices;  // Primitive::choices
  };
  const tinygltf::Primitive* primitive = nullptr;
  const Material* material = nullptr;  // what the first user wears, or could wear, that asks most of the mesh
  std::string where;
  bool shares_vertices = false;  // with primitives that take other triangles
  std::vector<User> users;

  std::shared_ptr<const Mesh> mesh;  // null if there is nothing to show
  std::shared_ptr<const Deformation> deformation;
  std::vector<std::string> warnings;
};
std::vector<MeshTask> mesh_tasks(const Document& document, const Scene& scene);
void read_mesh(const Document& document, MeshTask& task);
void place_meshes(const Document& document, const std::vector<MeshTask>& tasks, Scene& scene);

// One picture to decode; only those that textures show.
struct ImageTask {
  size_t image = 0;
  std::shared_ptr<const image::Image> picture;  // null if it could not be decoded
  std::string warning;
};
std::vector<ImageTask> image_tasks(const Document& document);
void read_picture(const Document& document, ImageTask& task);
void place_pictures(const Document& document, const std::vector<ImageTask>& tasks, Scene& scene);

// Morph targets and joints of a primitive; null if it is rigid.
std::shared_ptr<Deformation> read_deformation(const Document& document, const MeshTask& task,
                                              const std::vector<uint32_t>& selection, size_t vertices,
                                              std::vector<std::string>& warnings);
// The deformation of vertices that were copied or reordered.
void follow(Deformation& deformation, const std::vector<uint32_t>& sources, size_t old_vertices);

// Members of an extension; `usual` where they are missing.
const tinygltf::Value* extension_of(const tinygltf::ExtensionMap& extensions, const char* name);
float number_of(const tinygltf::Value& object, const char* member, float usual);
int index_of(const tinygltf::Value& object, const char* member, int usual);
Rgb color_of(const tinygltf::Value& object, const char* member, const Rgb& usual);

}  // namespace etendue::scene::gltf
