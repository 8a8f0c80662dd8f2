// Primitives: vertex attributes, triangles, and the repairs that raw files need.                glTF 2.0, section 3.7
#include <map>
#include <numeric>

#include "geometry/mesh_build.h"
#include "geometry/tangents.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/import.h"
#include "scene/gltf/triangles.h"

namespace etendue::scene::gltf {
namespace {

// What the material asks of the mesh: tangents along the coordinates of one texture.
struct TangentNeed {
  bool needed = false;
  int set = 0;
  Vec2 scale{1};
  float rotation = 0;

  auto key() const { return std::tuple(needed, set, scale.x, scale.y, rotation); }
};

TangentNeed tangent_need(const Material& material) {
  const bool mapped = material.normal_texture.texture >= 0, coat = material.clearcoat_normal_texture.texture >= 0;
  const TextureUse& use = mapped ? material.normal_texture
                          : coat ? material.clearcoat_normal_texture
                                 : material.anisotropy_texture;
  return {mapped || coat || material.anisotropy > 0, use.uv_set, use.scale, use.rotation};
}

glm::mat2 to_texture(const TangentNeed& need) {
  TextureUse use;
  use.scale = need.scale, use.rotation = need.rotation;
  return {transformed(use, Vec2(1, 0)), transformed(use, Vec2(0, 1))};
}

template <class V>
bool finite(const V& v) {
  for (int c = 0; c < V::length(); ++c)
    if (!std::isfinite(v[c])) return false;
  return true;
}

// Of all that a primitive can wear, the first that needs tangents; its own if none does.
const Material& most_demanding(const Scene& scene, int own, const std::vector<int>& choices) {
  const auto material = [&](int i) -> const Material& { return scene.materials[static_cast<size_t>(i)]; };
  if (!tangent_need(material(own)).needed)
    for (const int choice : choices)
      if (tangent_need(material(choice)).needed) return material(choice);
  return material(own);
}

class MeshReader {
 public:
  MeshReader(const Document& document, MeshTask& task) : document_(document), task_(task), from_(*task.primitive) {}

  void run() {
    const auto position = from_.attributes.find("POSITION");
    if (position == from_.attributes.end()) return warn("has no POSITION; it is left out");
    auto mesh = std::make_shared<Mesh>();
    vertices_ = count_of(document_, position->second);
    if (document_.model.accessors[static_cast<size_t>(position->second)].bufferView < 0)
      claim(document_, vertices_ * sizeof(uint32_t), task_.where);
    mesh->triangles = read_triangles(document_, from_, vertices_, task_.where, task_.warnings);
    if (mesh->triangles.empty()) return;
    if (task_.shares_vertices || mesh->triangles.size() < vertices_ / 3)
      selection_ = compact(mesh->triangles, vertices_);
    mesh->positions = read_vec3(document_, position->second, Use::position, selection(), at_attribute("POSITION"));
    vertices_ = mesh->positions.size();
    read_attributes(*mesh);
    auto deformation = read_deformation(document_, task_, selection_, vertices_, task_.warnings);
    tidy(*mesh, deformation == nullptr);
    if (mesh->triangles.empty()) return;
    add_tangents(*mesh, deformation.get());
    task_.mesh = std::move(mesh);
    task_.deformation = std::move(deformation);
  }

 private:
  void warn(const std::string& what) { task_.warnings.push_back(task_.where + ": " + what); }
  std::string at_attribute(const std::string& name) const { return task_.where + ".attributes." + name; }
  Selection selection() const { return selection_.empty() ? nullptr : &selection_; }

  template <class Values, class Read>
  bool read(const char* name, Use use, Values& values, Read&& reader) {
    const auto found = from_.attributes.find(name);
    if (found == from_.attributes.end()) return false;
    values = reader(document_, found->second, use, selection(), at_attribute(name));
    return true;
  }

  void read_attributes(Mesh& mesh) {
    if (read("NORMAL", Use::normal, mesh.normals, read_vec3) && read("TANGENT", Use::tangent, mesh.tangents, read_vec4))
      check_tangents(mesh);
    const char* const names[] = {"TEXCOORD_0", "TEXCOORD_1"};
    for (size_t set = 0; set < 2; ++set)
      if (read(names[set], Use::uv, mesh.uvs[set], read_vec2))
        replace_wrong(mesh.uvs[set], Vec2(0), names[set], "coordinates that are no numbers became 0");
    if (read("COLOR_0", Use::color, mesh.colors, read_vec4)) {
      replace_wrong(mesh.colors, Vec4(1), "COLOR_0", "colours that are no numbers became white");
      for (Vec4& color : mesh.colors) color = glm::clamp(color, 0.0f, 1.0f);
    }
  }

  template <class V>
  void replace_wrong(std::vector<V>& values, const V& with, const char* name, const char* what) {
    size_t wrong = 0;
    for (V& v : values)
      if (!finite(v)) v = with, ++wrong;
    if (wrong > 0) warn(std::string(name) + ": " + std::to_string(wrong) + " " + what);
  }

  // Half-right tangents would bend the light at random, so they are made anew if a material needs them.
  void check_tangents(Mesh& mesh) {
    const auto wrong = [](const Vec4& t) { return !finite(t) || !(length_squared(Vec3(t)) > 0); };
    if (std::any_of(mesh.tangents.begin(), mesh.tangents.end(), wrong)) {
      warn("TANGENT has vectors without direction; all are ignored");
      mesh.tangents.clear();
    }
    for (Vec4& t : mesh.tangents) t.w = t.w < 0 ? -1.0f : 1.0f;
  }

  // A deformed mesh keeps triangles that are empty or coincide at rest: they may open.
  void tidy(Mesh& mesh, bool rigid) {
    if (const size_t n = drop_non_finite(mesh))
      warn(std::to_string(n) + " triangles with positions that are no finite numbers were dropped");
    if (rigid)
      if (const size_t n = drop_degenerate(mesh)) warn(std::to_string(n) + " triangles without area were dropped");
    if (rigid)
      if (const size_t n = drop_duplicates(mesh))
        warn(std::to_string(n) + " triangles that lie exactly on others were dropped");
    if (const size_t n = repair_normals(mesh))
      warn(std::to_string(n) + " normals without direction were made from the triangles around them");
  }

  void add_tangents(Mesh& mesh, Deformation* deformation) {
    const TangentNeed need = tangent_need(*task_.material);
    if (!need.needed || !mesh.tangents.empty()) return;
    const auto set = static_cast<size_t>(need.set);
    if (mesh.uvs[set].empty())
      return warn("has no TEXCOORD_" + std::to_string(set) + ", which its material needs to turn normals");
    const size_t before = mesh.positions.size();
    if (mesh.normals.empty()) {
      const auto sources = split_into_flat_triangles(mesh);
      if (deformation) follow(*deformation, sources, before);
    }
    const size_t rigid = mesh.positions.size();
    const auto copies = generate_tangents(mesh, set, to_texture(need));
    if (!deformation || copies.empty()) return;
    std::vector<uint32_t> sources(rigid);
    std::iota(sources.begin(), sources.end(), 0U);
    sources.insert(sources.end(), copies.begin(), copies.end());
    follow(*deformation, sources, rigid);
  }

  const Document& document_;
  MeshTask& task_;
  const tinygltf::Primitive& from_;
  size_t vertices_ = 0;
  std::vector<uint32_t> selection_;  // empty: all vertices
};

}  // namespace

std::vector<MeshTask> mesh_tasks(const Document& document, const Scene& scene) {
  std::vector<MeshTask> tasks;
  using Attributes = std::map<std::string, int>;
  using Key = std::tuple<Attributes, int, int, std::vector<Attributes>, decltype(TangentNeed{}.key())>;
  std::map<Key, size_t> known;
  std::map<int, size_t> uses_of_position;
  for (size_t m = 0; m < document.model.meshes.size(); ++m) {
    const auto& primitives = document.model.meshes[m].primitives;
    for (size_t p = 0; p < primitives.size(); ++p) {
      const auto& from = primitives[p];
      const int material = from.material >= 0 ? from.material : static_cast<int>(scene.materials.size()) - 1;
      const std::string where = at("meshes", m) + "." + at("primitives", p);
      std::vector<int> choices = material_choices(document, scene, from, material, where);
      const Material& needs = most_demanding(scene, material, choices);
      const auto [place, added] = known.try_emplace(
          Key(from.attributes, from.indices, from.mode, from.targets, tangent_need(needs).key()), tasks.size());
      if (added) {
        MeshTask task;
        task.primitive = &from, task.material = &needs;
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

void read_mesh(const Document& document, MeshTask& task) { MeshReader(document, task).run(); }

void place_meshes(const Document& document, const std::vector<MeshTask>& tasks, Scene& scene) {
  std::vector<std::pair<const MeshTask*, MeshTask::User>> users;
  for (const MeshTask& task : tasks)
    for (const auto& user : task.users) users.emplace_back(&task, user);
  std::sort(users.begin(), users.end(), [](const auto& a, const auto& b) {
    return std::pair(a.second.mesh, a.second.primitive) < std::pair(b.second.mesh, b.second.primitive);
  });
  for (const auto& from : document.model.meshes) {
    MeshGroup group;
    group.name = from.name;
    for (const double w : from.weights) group.weights.push_back(static_cast<float>(w));
    scene.meshes.push_back(std::move(group));
  }
  for (const auto& [task, user] : users)
    if (task->mesh)
      scene.meshes[user.mesh].primitives.push_back({task->mesh, task->deformation, user.material, user.choices});
}

}  // namespace etendue::scene::gltf
