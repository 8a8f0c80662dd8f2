// Imports primitives: vertex attributes, triangles, and repairs of defective data.              glTF 2.0, section 3.7
#include <limits>
#include <map>
#include <numeric>

#include "geometry/mesh_build.h"
#include "geometry/tangents.h"
#include "scene/coordinate_range.h"
#include "scene/gltf/import/accessor.h"
#include "scene/gltf/import/importers.h"
#include "scene/gltf/import/primitive_triangles.h"
#include "scene/pose.h"

namespace etendue::scene::gltf {
namespace {

// Whether a material needs tangents, and for which texture coordinates.
struct TangentRequirement {
  bool needed = false;
  int set = 0;
  Vec2 scale{1};
  float rotation = 0;

  auto key() const { return std::tuple(needed, set, scale.x, scale.y, rotation); }
};

TangentRequirement tangent_requirement(const Material& material) {
  const bool mapped = material.normal_texture.texture >= 0, coat = material.clearcoat_normal_texture.texture >= 0;
  const TextureUse& use = mapped ? material.normal_texture
                          : coat ? material.clearcoat_normal_texture
                                 : material.anisotropy_texture;
  return {mapped || coat || material.anisotropy > 0, use.uv_set, use.scale, use.rotation};
}

// The linear part of the texture transform.
glm::mat2 to_texture(const TangentRequirement& requirement) {
  TextureUse use;
  use.scale = requirement.scale;
  use.rotation = requirement.rotation;
  return {transformed(use, Vec2(1, 0)), transformed(use, Vec2(0, 1))};
}

template <class V>
bool is_finite_vector(const V& v) {
  for (int c = 0; c < V::length(); ++c)
    if (!std::isfinite(v[c])) return false;
  return true;
}

// The first material of a primitive, over all variants, that needs tangents; `material` if none does.
const Material& material_with_tangents(const Scene& scene, int material, const std::vector<int>& choices) {
  const auto material_at = [&](int i) -> const Material& { return scene.materials[static_cast<size_t>(i)]; };
  if (!tangent_requirement(material_at(material)).needed)
    for (const int choice : choices)
      if (tangent_requirement(material_at(choice)).needed) return material_at(choice);
  return material_at(material);
}

class MeshReader {
 public:
  MeshReader(const InputFile& input, MeshTask& task) : input_(input), task_(task), from_(*task.primitive) {}

  void run() {
    const auto position = from_.attributes.find("POSITION");
    if (position == from_.attributes.end()) return warn("has no POSITION; the primitive is not rendered");
    auto mesh = std::make_shared<Mesh>();
    vertices_ = count_of(input_, position->second);
    if (input_.model.accessors[static_cast<size_t>(position->second)].bufferView < 0)
      check_memory(input_, vertices_ * sizeof(uint32_t), task_.where);
    mesh->triangles = read_triangles(input_, from_, vertices_, task_.where, task_.warnings);
    if (mesh->triangles.empty()) return;
    if (task_.shares_vertices || mesh->triangles.size() < vertices_ / 3)
      selection_ = compact_vertices(mesh->triangles, vertices_);
    mesh->positions = read_vec3(input_, position->second, AccessorUse::position, selection(), at_attribute("POSITION"));
    vertices_ = mesh->positions.size();
    read_attributes(*mesh);
    auto deformation = read_deformation(input_, task_, selection_, vertices_, task_.warnings);
    repair(*mesh, deformation == nullptr);
    if (mesh->triangles.empty()) return;
    add_tangents(*mesh, deformation.get());
    task_.mesh = std::move(mesh);
    task_.deformation = std::move(deformation);
  }

 private:
  void warn(const std::string& what) { task_.warnings.push_back(task_.where + ": " + what); }
  std::string at_attribute(const std::string& name) const { return task_.where + ".attributes." + name; }
  VertexSelection selection() const { return selection_.empty() ? nullptr : &selection_; }

  template <class Values, class Read>
  bool read(const char* name, AccessorUse use, Values& values, Read&& reader) {
    const auto found = from_.attributes.find(name);
    if (found == from_.attributes.end()) return false;
    values = reader(input_, found->second, use, selection(), at_attribute(name));
    return true;
  }

  void read_attributes(Mesh& mesh) {
    if (read("NORMAL", AccessorUse::normal, mesh.normals, read_vec3) &&
        read("TANGENT", AccessorUse::tangent, mesh.tangents, read_vec4))
      check_tangents(mesh);
    const char* const names[] = {"TEXCOORD_0", "TEXCOORD_1"};
    for (size_t set = 0; set < 2; ++set)
      if (read(names[set], AccessorUse::uv, mesh.uvs[set], read_vec2))
        replace_invalid(mesh.uvs[set], Vec2(0), names[set], "coordinates that are not finite were replaced by 0");
    if (read("COLOR_0", AccessorUse::color, mesh.colors, read_vec4)) {
      replace_invalid(mesh.colors, Vec4(1), "COLOR_0", "colours that are not finite were replaced by white");
      for (Vec4& color : mesh.colors) color = glm::clamp(color, 0.0f, 1.0f);
    }
  }

  template <class V>
  void replace_invalid(std::vector<V>& values, const V& with, const char* name, const char* what) {
    size_t invalid = 0;
    for (V& v : values) {
      if (is_finite_vector(v)) continue;
      v = with;
      ++invalid;
    }
    if (invalid > 0) warn(std::string(name) + ": " + std::to_string(invalid) + " " + what);
  }

  // Tangents that are partly invalid would give random shading. All are dropped, and generated if a material needs
  // them.
  void check_tangents(Mesh& mesh) {
    const auto is_invalid = [](const Vec4& t) { return !is_finite_vector(t) || !(length_squared(Vec3(t)) > 0); };
    if (std::any_of(mesh.tangents.begin(), mesh.tangents.end(), is_invalid)) {
      warn("TANGENT contains vectors that are zero or not finite; all tangents are ignored");
      mesh.tangents.clear();
    }
    for (Vec4& t : mesh.tangents) t.w = t.w < 0 ? -1.0f : 1.0f;
  }

  // A mesh that deforms keeps degenerate and coincident triangles: they may change when it moves.
  void repair(Mesh& mesh, bool rigid) {
    for (Vec3& p : mesh.positions)
      if (!is_within_range(p)) p = Vec3(std::numeric_limits<float>::quiet_NaN());
    if (const size_t n = drop_non_finite(mesh))
      warn(std::to_string(n) + " triangles with positions that are not finite or beyond 1e9 m were dropped");
    if (rigid)
      if (const size_t n = drop_degenerate(mesh)) warn(std::to_string(n) + " triangles without area were dropped");
    if (rigid)
      if (const size_t n = drop_duplicates(mesh)) warn(std::to_string(n) + " duplicate triangles were dropped");
    if (const size_t n = repair_normals(mesh))
      warn(std::to_string(n) +
           " normals that are zero or not finite were replaced by the mean of the adjacent triangles");
  }

  void add_tangents(Mesh& mesh, Deformation* deformation) {
    const TangentRequirement requirement = tangent_requirement(*task_.material);
    if (!requirement.needed || !mesh.tangents.empty()) return;
    const auto set = static_cast<size_t>(requirement.set);
    if (mesh.uvs[set].empty())
      return warn("has no TEXCOORD_" + std::to_string(set) +
                  ", which the normal map or anisotropy of its material needs");
    const size_t old_vertices = mesh.positions.size();
    if (mesh.normals.empty()) {
      const auto sources = split_into_flat_triangles(mesh);
      if (deformation) reorder_vertices(*deformation, sources, old_vertices);
    }
    const size_t original = mesh.positions.size();
    const auto copies = generate_tangents(mesh, set, to_texture(requirement));
    if (!deformation || copies.empty()) return;
    std::vector<uint32_t> sources(original);
    std::iota(sources.begin(), sources.end(), 0U);
    sources.insert(sources.end(), copies.begin(), copies.end());
    reorder_vertices(*deformation, sources, original);
  }

  const InputFile& input_;
  MeshTask& task_;
  const tinygltf::Primitive& from_;
  size_t vertices_ = 0;
  std::vector<uint32_t> selection_;  // empty: all vertices
};

}  // namespace

namespace {

Bounds transformed(const Bounds& bounds, const Mat4& m) {
  Bounds result;
  for (int corner = 0; corner < 8 && !bounds.empty(); ++corner)
    result.extend(Vec3(m * Vec4(corner & 1 ? bounds.max.x : bounds.min.x, corner & 2 ? bounds.max.y : bounds.min.y,
                                corner & 4 ? bounds.max.z : bounds.min.z, 1)));
  return result;
}

}  // namespace

std::vector<MeshTask> mesh_tasks(const InputFile& input, const Scene& scene) {
  std::vector<MeshTask> tasks;
  using Attributes = std::map<std::string, int>;
  using Key = std::tuple<Attributes, int, int, std::vector<Attributes>, decltype(TangentRequirement{}.key())>;
  std::map<Key, size_t> task_of;
  std::map<int, size_t> uses_of_position;
  for (size_t m = 0; m < input.model.meshes.size(); ++m) {
    const auto& primitives = input.model.meshes[m].primitives;
    for (size_t p = 0; p < primitives.size(); ++p) {
      const auto& from = primitives[p];
      const int material = from.material >= 0 ? from.material : static_cast<int>(scene.materials.size()) - 1;
      const std::string where = at("meshes", m) + "." + at("primitives", p);
      std::vector<int> choices = variant_materials(input, scene, from, material, where);
      const Material& with_tangents = material_with_tangents(scene, material, choices);
      const auto [place, added] = task_of.try_emplace(
          Key(from.attributes, from.indices, from.mode, from.targets, tangent_requirement(with_tangents).key()),
          tasks.size());
      if (added) {
        MeshTask task;
        task.primitive = &from;
        task.material = &with_tangents;
        task.where = where;
        tasks.push_back(std::move(task));
        if (const auto position = from.attributes.find("POSITION"); position != from.attributes.end())
          ++uses_of_position[position->second];
      }
      tasks[place->second].users.push_back({m, p, material, std::move(choices)});
    }
  }
  for (MeshTask& task : tasks)
    if (const auto position = task.primitive->attributes.find("POSITION"); position != task.primitive->attributes.end())
      task.shares_vertices = uses_of_position[position->second] > 1;
  return tasks;
}

void read_mesh(const InputFile& input, MeshTask& task) { MeshReader(input, task).run(); }

void add_meshes(const InputFile& input, const std::vector<MeshTask>& tasks, Scene& scene) {
  std::vector<std::pair<const MeshTask*, MeshTask::User>> users;
  for (const MeshTask& task : tasks)
    for (const auto& user : task.users) users.emplace_back(&task, user);
  std::sort(users.begin(), users.end(), [](const auto& a, const auto& b) {
    return std::pair(a.second.mesh, a.second.primitive) < std::pair(b.second.mesh, b.second.primitive);
  });
  for (const auto& from : input.model.meshes) {
    MeshGroup group;
    group.name = from.name;
    for (const double w : from.weights) group.weights.push_back(static_cast<float>(w));
    scene.meshes.push_back(std::move(group));
  }
  for (const auto& [task, user] : users)
    if (task->mesh)
      scene.meshes[user.mesh].primitives.push_back({task->mesh, task->deformation, user.material, user.choices});
}

void remove_far_meshes(Scene& scene) {
  for (const int n : nodes_out_of_range(scene))
    scene.warnings.push_back(at("nodes", static_cast<size_t>(n)) +
                             ": its world transform is not finite or beyond 1e9; the node is not rendered");
  const std::vector<Mat4> world = world_matrices(scene);
  std::map<const Mesh*, Bounds> bounds;
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    Node& node = scene.nodes[n];
    if (node.mesh < 0 || node.skin >= 0) continue;
    Bounds box;
    for (const Primitive& primitive : scene.meshes[static_cast<size_t>(node.mesh)].primitives) {
      const auto [place, added] = bounds.try_emplace(primitive.mesh.get());
      if (added) place->second = bounds_of(*primitive.mesh, Mat4(1));
      box.extend(transformed(place->second, world[n]));
    }
    if (box.empty() || (is_within_range(box.min) && is_within_range(box.max))) continue;
    scene.warnings.push_back(at("nodes", n) + ": places meshes[" + std::to_string(node.mesh) +
                             "] farther than 1e9 m from the origin; the mesh is not rendered");
    node.mesh = -1;
  }
}

}  // namespace etendue::scene::gltf
