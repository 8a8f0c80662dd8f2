// Exports meshes as floats. Primitives that share arrays in memory share accessors in the file.
#include "scene/gltf/export/output_file.h"

namespace etendue::scene::gltf {
namespace {

constexpr int kFloat = TINYGLTF_COMPONENT_TYPE_FLOAT, kUShort = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
              kUInt = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;

class MeshExporter {
 public:
  explicit MeshExporter(OutputFile& out) : out_(out) {}

  void run() {
    for (const MeshGroup& mesh : out_.scene.meshes) {
      Json primitives = Json::array();
      for (const Primitive& p : mesh.primitives)
        if (!p.mesh->triangles.empty()) primitives.push_back(primitive(p));
      // A glTF mesh has at least one primitive.
      out_.mesh_indices.push_back(primitives.empty() ? -1 : write(mesh, std::move(primitives)));
    }
  }

 private:
  int write(const MeshGroup& mesh, Json primitives) {
    Json to{{"primitives", std::move(primitives)}};
    put_name(to, mesh.name);
    if (!mesh.weights.empty()) to["weights"] = numbers(mesh.weights);
    return out_.add("meshes", std::move(to));
  }

  Json primitive(const Primitive& p) {
    Json& shape = shapes_[{p.mesh.get(), p.deformation.get()}];
    if (shape.is_null()) {
      shape = {{"attributes", attributes(*p.mesh)}, {"indices", indices(*p.mesh)}};
      if (p.deformation) deform(shape, *p.deformation, p.mesh->positions.size());
    }
    Json to = shape;
    const int material = material_index(out_.scene, p.choices.empty() ? p.material : p.choices.front());
    if (material >= 0) to["material"] = material;
    if (Json mappings = mappings_of(p); !mappings.empty())
      out_.extend(to, "KHR_materials_variants")["mappings"] = std::move(mappings);
    return to;
  }

  // One mapping per material with all variants that use it. Variants that use the default material are omitted.
  static Json mappings_of(const Primitive& p) {
    std::map<int, std::vector<size_t>> variants;
    for (size_t c = 1; c < p.choices.size(); ++c)
      if (p.choices[c] != p.choices[0]) variants[p.choices[c]].push_back(c - 1);
    Json mappings = Json::array();
    for (const auto& [material, used_by] : variants)
      mappings.push_back({{"material", material}, {"variants", used_by}});
    return mappings;
  }

  template <class V>
  int vectors(const std::vector<V>& values, const char* type) {
    return out_.accessor(values, kFloat, type, kVertices);
  }
  // glTF requires the bounds of positions.
  int positions(const std::vector<Vec3>& values) {
    const int accessor = vectors(values, "VEC3");
    Bounds bounds;
    for (const Vec3& p : values) bounds.extend(p);
    if (bounds.empty()) return accessor;
    Json& a = out_.root["accessors"].back();
    a["min"] = vector(bounds.min);
    a["max"] = vector(bounds.max);
    return accessor;
  }

  Json attributes(const Mesh& mesh) {
    Json to{{"POSITION", positions(mesh.positions)}};
    if (!mesh.normals.empty()) to["NORMAL"] = vectors(mesh.normals, "VEC3");
    if (!mesh.tangents.empty()) to["TANGENT"] = vectors(mesh.tangents, "VEC4");
    if (!mesh.uvs[0].empty()) to["TEXCOORD_0"] = vectors(mesh.uvs[0], "VEC2");
    if (!mesh.uvs[1].empty()) to["TEXCOORD_1"] = vectors(mesh.uvs[1], "VEC2");
    if (!mesh.colors.empty()) to["COLOR_0"] = vectors(mesh.colors, "VEC4");
    return to;
  }

  int indices(const Mesh& mesh) {
    const std::span<const uint32_t> corners(mesh.triangles.front().data(), mesh.triangles.size() * 3);
    // The largest value of an index type is the primitive restart value, which glTF forbids.
    if (mesh.positions.size() >= 0xffff)
      return out_.accessor(std::as_bytes(corners), kUInt, "SCALAR", corners.size(), kIndices);
    const std::vector<uint16_t> small(corners.begin(), corners.end());
    return out_.accessor(small, kUShort, "SCALAR", kIndices);
  }

  void deform(Json& shape, const Deformation& deformation, size_t vertices) {
    for (const MorphTarget& target : deformation.targets) {
      Json to = Json::object();
      if (!target.positions.empty()) to["POSITION"] = positions(target.positions);
      if (!target.normals.empty()) to["NORMAL"] = vectors(target.normals, "VEC3");
      if (!target.tangents.empty()) to["TANGENT"] = vectors(target.tangents, "VEC3");
      shape["targets"].push_back(std::move(to));
    }
    for (size_t set = 0; set < deformation.joint_sets; ++set) {
      const auto part = [&](const auto& values) {
        return std::as_bytes(std::span(values).subspan(set * vertices, vertices));
      };
      const std::string suffix = "_" + std::to_string(set);
      shape["attributes"]["JOINTS" + suffix] =
          out_.accessor(part(deformation.joints), kUShort, "VEC4", vertices, kVertices);
      shape["attributes"]["WEIGHTS" + suffix] =
          out_.accessor(part(deformation.weights), kFloat, "VEC4", vertices, kVertices);
    }
  }

  OutputFile& out_;
  std::map<std::pair<const Mesh*, const Deformation*>, Json> shapes_;
};

}  // namespace

void export_meshes(OutputFile& out) {
  MeshExporter(out).run();
  if (out.scene.variants.empty()) return;
  Json& names = out.extend(out.root, "KHR_materials_variants")["variants"];
  for (const std::string& name : out.scene.variants) names.push_back({{"name", name}});
}

}  // namespace etendue::scene::gltf
