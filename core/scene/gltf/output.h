// A glTF file in the making: what the parts of the writer share.
#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf/document.h"
#include "scene/scene.h"

namespace etendue::scene::gltf {

using Json = nlohmann::json;

struct Output {
  explicit Output(const Scene& from) : scene(from) {}

  const Scene& scene;
  Json root = Json::object();
  std::vector<std::byte> binary;                 // the one buffer
  std::vector<std::vector<std::byte>> pictures;  // PNG, for the images of `root`
  std::set<std::string> extensions;              // that are used
  std::vector<std::string> warnings;
  std::vector<int> mesh_numbers;  // of the scene's meshes in the file; -1 for one with nothing in it

  // Adds an object to an array of the root; its index.
  int add(const char* array, Json object);

  // Bytes as a bufferView; its index. A target is 34962 (vertices) or 34963 (indices), or 0.
  int view(std::span<const std::byte> bytes, int target = 0);
  // Elements of one kind as an accessor; its index. With bounds where the specification asks for them.
  int accessor(std::span<const std::byte> bytes, int component_type, const char* type, size_t count, int target = 0);
  template <class T>
  int accessor(const std::vector<T>& values, int component_type, const char* type, int target = 0) {
    return accessor(std::as_bytes(std::span(values)), component_type, type, values.size(), target);
  }
  int floats(const std::vector<float>& values);

  // An extension of an object, and a note that the file uses it.
  Json& extend(Json& object, const char* extension);
};

inline constexpr int kVertices = 34962, kIndices = 34963;

// A float with as few digits as give it back to whoever reads it.
Json number(float value);
Json numbers(std::span<const float> values);
template <class V>
Json vector(const V& v) {
  Json array = Json::array();
  for (int c = 0; c < V::length(); ++c) array.push_back(number(v[c]));
  return array;
}
Json vector(const Rgb& color);
void put(Json& object, const char* member, float value, float usual);
void put_name(Json& object, const std::string& name);

// The parts, in the order in which they are made.
void write_textures(Output& out);
void write_materials(Output& out);
void write_meshes(Output& out);
void write_cameras_and_lights(Output& out);
void write_nodes(Output& out);
void write_skins(Output& out);
void write_animations(Output& out);
// ETENDUE_transport; `folder` is where the file will be.
void write_transport(Output& out, const std::filesystem::path& folder);
void write_lens(Output& out, const Camera& camera, Json& object);
void write_reflection(Output& out, const BsdfModelRef& reflection, Json& object);
void write_shape(Output& out, const Light& light, Json& object);

// The index of a material in the file, or -1 where the specification's default, which is not written, stands.
int written_material(const Scene& scene, int material);

}  // namespace etendue::scene::gltf
