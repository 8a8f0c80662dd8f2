// A glTF file that is being written: what all parts of the exporter share.
#pragma once
#include <tiny_gltf.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf/file_error.h"
#include "scene/gltf/transport_extension.h"
#include "scene/scene.h"

namespace etendue::scene::gltf {

using Json = nlohmann::json;

struct OutputFile {
  explicit OutputFile(const Scene& from) : scene(from) {}

  const Scene& scene;
  Json root = Json::object();
  std::vector<std::byte> binary;               // the only buffer
  std::vector<std::vector<std::byte>> images;  // PNG files, in the order of the images of `root`
  std::set<std::string> extensions;            // used ones
  std::filesystem::path folder;  // of the file, base of relative URIs
  std::vector<std::string> warnings;
  std::vector<int> mesh_indices;  // for each mesh of the scene its index in the file; -1 for an empty mesh

  // Appends an object to an array of the root; returns its index.
  int add(const char* array, Json object);

  // Adds a buffer view; returns its index. `target` is kVertices, kIndices, or 0 for none.
  int view(std::span<const std::byte> bytes, int target = 0);
  // Adds an accessor; returns its index.
  int accessor(std::span<const std::byte> bytes, int component_type, const char* type, size_t count, int target = 0);
  template <class T>
  int accessor(const std::vector<T>& values, int component_type, const char* type, int target = 0) {
    return accessor(std::as_bytes(std::span(values)), component_type, type, values.size(), target);
  }
  int floats(const std::vector<float>& values);

  // The extension object of `object`, added if it is missing, and registered as used by the file.
  Json& extend(Json& object, const char* extension);
};

// Values of bufferView.target.
inline constexpr int kVertices = 34962, kIndices = 34963;

// The shortest decimal number that reads as the same float.
Json number(float value);
Json numbers(std::span<const float> values);
template <class V>
Json vector(const V& v) {
  Json array = Json::array();
  for (int c = 0; c < V::length(); ++c) array.push_back(number(v[c]));
  return array;
}
Json vector(const Rgb& color);
// Sets a member unless the value is the default.
void put(Json& object, const char* member, float value, float default_value);
void put_name(Json& object, const std::string& name);

// The parts of the exporter, in the order in which they run.
void export_textures(OutputFile& out);
void export_materials(OutputFile& out);
void export_meshes(OutputFile& out);
void export_cameras_and_lights(OutputFile& out, const std::filesystem::path& folder);
void export_nodes(OutputFile& out);
void export_skins(OutputFile& out);
void export_animations(OutputFile& out);
// ETENDUE_transport of the root; `folder` is that of the file.
void export_transport(OutputFile& out, const std::filesystem::path& folder);
// ETENDUE_transport of a camera, a material and a light.
void export_camera_extension(OutputFile& out, const Camera& camera, Json& object);
void export_bsdf_model(OutputFile& out, const BsdfModelRef& model, Json& object);
void export_layering(OutputFile& out, Layering layering, Json& object);
void export_glass(OutputFile& out, Glass glass, Json& object);
void export_emission_spectrum(OutputFile& out, const EmissionSpectrumRef& spectrum, Json& object);
void export_medium(OutputFile& out, const Material& material, Json& object);
void export_light_extension(OutputFile& out, const Light& light, const std::filesystem::path& folder, Json& object);

// The index of a material in the file; -1 for the default material of the specification, which is not written.
int material_index(const Scene& scene, int material);

}  // namespace etendue::scene::gltf
