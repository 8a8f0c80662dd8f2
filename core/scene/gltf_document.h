// A parsed glTF file on its way to a Scene: what all parts of the importer share.
//
// Inside the importer what makes a file unusable is thrown as Unusable and caught in load_gltf, which puts the file's name in
// front. `where` names the object as "meshes[3].primitives[0]".
#pragma once
#include <tiny_gltf.h>

#include <functional>

#include <string>
#include <vector>

#include "scene/scene.h"

namespace etendue::scene::gltf {

struct Unusable {
  std::string message;
};

[[noreturn]] inline void fail(const std::string& where, const std::string& what) { throw Unusable{where + ": " + what}; }

inline std::string at(const char* array, size_t i) { return std::string(array) + "[" + std::to_string(i) + "]"; }

struct Document {
  tinygltf::Model model;
  std::vector<std::vector<unsigned char>> image_files;  // bytes of images that do not lie in a buffer, by image
  std::string folder;
};

// `i` if it is an index below `size`; -1 stays; anything else is unusable.
int checked_index(int i, size_t size, const std::string& where, const char* of);

// Everything the importer relies on afterwards: views lie in their buffers, accessors in their views, nodes form trees.
void validate(const Document& document);

// The names of extensions the importer understands.
bool is_supported(const std::string& extension);

// Numbers of an accessor as floats (normalised integers scaled, sparse values applied), `components` each.
std::vector<float> read_floats(const Document& document, int accessor, int components, const std::string& where);
std::vector<Vec2> read_vec2(const Document& document, int accessor, const std::string& where);
std::vector<Vec3> read_vec3(const Document& document, int accessor, const std::string& where);
std::vector<Vec4> read_vec4(const Document& document, int accessor, const std::string& where);
// Unsigned integers: indices and joints.
std::vector<uint32_t> read_integers(const Document& document, int accessor, int components, const std::string& where);
size_t count_of(const Document& document, int accessor);

// The parts of a scene, in the order they are made.
void import_textures(const Document& document, Scene& scene);
void import_materials(const Document& document, Scene& scene);
void import_meshes(const Document& document, Scene& scene, const std::function<bool(float)>& progress);
void import_lights(const Document& document, Scene& scene);
void import_cameras(const Document& document, Scene& scene);
void import_nodes(const Document& document, Scene& scene, int wanted_scene);
void import_skins(const Document& document, Scene& scene);
void import_animations(const Document& document, Scene& scene);

// Members of an extension's JSON; the default where they are missing or of another type.
const tinygltf::Value* extension_of(const tinygltf::ExtensionMap& extensions, const char* name);
float number_of(const tinygltf::Value& object, const char* key, float usual);
Rgb color_of(const tinygltf::Value& object, const char* key, const Rgb& usual);

}  // namespace etendue::scene::gltf
