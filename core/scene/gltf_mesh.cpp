// Meshes: triangles of every mode, attributes, morph targets.                                 glTF 2.0, section 3.7
#include <unordered_set>

#include "base/hash.h"
#include "geometry/tangents.h"
#include "scene/gltf_document.h"

namespace etendue::scene::gltf {
namespace {

constexpr uint64_t kMostVertices = uint64_t{1} << 31;

std::vector<uint32_t> indices_of(const Document& d, const tinygltf::Primitive& p, size_t vertices, const std::string& where) {
  std::vector<uint32_t> indices;
  if (p.indices < 0) {
    indices.resize(vertices);
    for (size_t i = 0; i < vertices; ++i) indices[i] = static_cast<uint32_t>(i);
    return indices;
  }
  indices = read_integers(d, p.indices, 1, where + ".indices");
  for (const uint32_t i : indices)
    if (i >= vertices) fail(where + ".indices", "index " + std::to_string(i) + " is out of range; there are " + std::to_string(vertices) + " vertices");
  return indices;
}

// Section 3.7.2.1: strips and fans as lists, with the winding that makes every triangle face the same way.
std::vector<Triangle> triangles_of(const std::vector<uint32_t>& i, int mode) {
  std::vector<Triangle> triangles;
  const size_t n = i.size();
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    triangles.reserve(n / 3);
    for (size_t k = 0; k + 2 < n; k += 3) triangles.push_back({i[k], i[k + 1], i[k + 2]});
  } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    for (size_t k = 0; k + 2 < n; ++k) triangles.push_back({i[k], i[k + 1 + k % 2], i[k + 2 - k % 2]});
  } else {
    for (size_t k = 1; k + 1 < n; ++k) triangles.push_back({i[k], i[k + 1], i[0]});
  }
  return triangles;
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

uint64_t key_of(const Triangle& t) {
  const Triangle s = sorted(t);
  return mix_bits(mix_bits(uint64_t{s[0]} << 32 | s[1]) ^ uint64_t{s[2]});
}

// Triangles without an area show nothing but make normals that are no numbers.
size_t drop_degenerate(Mesh& mesh) {
  const auto empty = [&](const Triangle& t) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const Vec3 n = glm::cross(b - a, c - a);
    const float area2 = length_squared(n);
    return !(area2 > 0) || !std::isfinite(area2);
  };
  return std::erase_if(mesh.triangles, empty);
}

// A second triangle over the same corners would be lit, and emit, twice. Sorting hashes tells fast that there are none.
size_t drop_duplicates(Mesh& mesh) {
  std::vector<uint64_t> keys;
  keys.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) keys.push_back(key_of(t));
  std::sort(keys.begin(), keys.end());
  if (std::adjacent_find(keys.begin(), keys.end()) == keys.end()) return 0;
  std::unordered_set<uint64_t> seen;
  return std::erase_if(mesh.triangles, [&](const Triangle& t) { return !seen.insert(key_of(t)).second; });
}

std::vector<Vec4> colors_of(const Document& d, int accessor, const std::string& where) {
  const auto& a = d.model.accessors[static_cast<size_t>(checked_index(accessor, d.model.accessors.size(), where, "accessors"))];
  if (a.type == TINYGLTF_TYPE_VEC4) return read_vec4(d, accessor, where);
  std::vector<Vec4> colors;
  for (const Vec3& c : read_vec3(d, accessor, where)) colors.emplace_back(c, 1);
  return colors;
}

template <class V>
bool all_finite(const std::vector<V>& values) {
  for (const V& v : values)
    for (int c = 0; c < V::length(); ++c)
      if (!std::isfinite(v[c])) return false;
  return true;
}

class PrimitiveImporter {
 public:
  PrimitiveImporter(const Document& d, const tinygltf::Primitive& from, Scene& scene, std::string where)
      : d_(d), from_(from), scene_(scene), where_(std::move(where)) {}

  // False if there is nothing to show.
  bool run(Primitive& to) {
    const int mode = from_.mode < 0 ? TINYGLTF_MODE_TRIANGLES : from_.mode;
    if (mode < TINYGLTF_MODE_TRIANGLES) {
      warn(std::string(mode == TINYGLTF_MODE_POINTS ? "points" : "lines") + " are not rendered");
      return false;
    }
    if (mode > TINYGLTF_MODE_TRIANGLE_FAN) fail(where_, "mode " + std::to_string(mode) + " does not exist");
    const int material = checked_index(from_.material, d_.model.materials.size(), where_ + ".material", "materials");
    to.material = material < 0 ? static_cast<int>(scene_.materials.size()) - 1 : material;

    const int position = attribute("POSITION");
    if (position < 0) {
      warn("has no POSITION; left out");
      return false;
    }
    auto mesh = std::make_shared<Mesh>();
    mesh->positions = read_vec3(d_, position, where_ + ".attributes.POSITION");
    if (mesh->positions.size() > kMostVertices) fail(where_, "has more vertices than can be numbered");
    if (!all_finite(mesh->positions)) fail(where_ + ".attributes.POSITION", "a position is not finite; give finite numbers");
    mesh->triangles = triangles_of(indices_of(d_, from_, mesh->positions.size(), where_), mode);
    attributes(*mesh);
    to.deformation = deformation(*mesh);
    if (!to.deformation) tidy(*mesh);
    if (mesh->triangles.empty()) return false;
    if (scene_.materials[static_cast<size_t>(to.material)].normal_texture.texture >= 0 && mesh->tangents.empty()) add_tangents(*mesh, to.material);
    to.mesh = std::move(mesh);
    return true;
  }

 private:
  int attribute(const std::string& name) const {
    const auto found = from_.attributes.find(name);
    return found == from_.attributes.end() ? -1 : checked_index(found->second, d_.model.accessors.size(), where_ + ".attributes." + name, "accessors");
  }

  void warn(const std::string& what) const { scene_.warnings.push_back(where_ + ": " + what); }

  template <class V, class Read>
  void optional(const char* name, std::vector<V>& to, size_t n, Read&& read) const {
    const int accessor = attribute(name);
    if (accessor < 0) return;
    const std::string where = where_ + ".attributes." + name;
    to = read(d_, accessor, where);
    if (to.size() != n) fail(where, "has " + std::to_string(to.size()) + " elements, but there are " + std::to_string(n) + " vertices");
    if (all_finite(to)) return;
    warn(std::string(name) + " has numbers that are not finite; left out");
    to.clear();
  }

  void attributes(Mesh& mesh) const {
    const size_t n = mesh.positions.size();
    optional("NORMAL", mesh.normals, n, read_vec3);
    if (!mesh.normals.empty()) optional("TANGENT", mesh.tangents, n, read_vec4);
    optional("TEXCOORD_0", mesh.uvs[0], n, read_vec2);
    optional("TEXCOORD_1", mesh.uvs[1], n, read_vec2);
    optional("COLOR_0", mesh.colors, n, colors_of);
  }

  std::shared_ptr<const Deformation> deformation(const Mesh& mesh) const {
    auto result = std::make_shared<Deformation>();
    const size_t n = mesh.positions.size();
    for (size_t t = 0; t < from_.targets.size(); ++t) {
      MorphTarget target;
      for (const auto& [name, accessor] : from_.targets[t]) {
        auto* to = name == "POSITION" ? &target.positions : name == "NORMAL" ? &target.normals : name == "TANGENT" ? &target.tangents : nullptr;
        if (!to) continue;
        const std::string where = where_ + ".targets[" + std::to_string(t) + "]." + name;
        *to = read_vec3(d_, accessor, where);
        if (to->size() != n || !all_finite(*to)) fail(where, "has to hold one finite displacement a vertex");
      }
      result->targets.push_back(std::move(target));
    }
    for (int set = 0;; ++set) {
      const std::string suffix = "_" + std::to_string(set);
      const int joints = attribute("JOINTS" + suffix), weights = attribute("WEIGHTS" + suffix);
      if (joints < 0 || weights < 0) break;
      const auto numbers = read_integers(d_, joints, 4, where_ + ".attributes.JOINTS" + suffix);
      const auto w = read_vec4(d_, weights, where_ + ".attributes.WEIGHTS" + suffix);
      if (numbers.size() != 4 * n || w.size() != n) fail(where_, "JOINTS" + suffix + " and WEIGHTS" + suffix + " have to have one element a vertex");
      for (size_t i = 0; i < n; ++i) {
        std::array<uint16_t, 4> four{};
        for (size_t k = 0; k < 4; ++k) four[k] = static_cast<uint16_t>(std::min<uint32_t>(numbers[4 * i + k], 65535));
        result->joints.push_back(four);
        result->weights.push_back(all_finite(std::vector<Vec4>{w[i]}) ? w[i] : Vec4(0));
      }
      ++result->joint_sets;
    }
    const bool any = !result->targets.empty() || result->joint_sets > 0;
    return any ? result : nullptr;
  }

  void tidy(Mesh& mesh) const {
    if (const size_t dropped = drop_degenerate(mesh)) warn(std::to_string(dropped) + " triangles without an area were dropped");
    if (const size_t dropped = drop_duplicates(mesh)) warn(std::to_string(dropped) + " triangles that stand there twice were dropped");
  }

  void add_tangents(Mesh& mesh, int material) const {
    const auto set = static_cast<size_t>(scene_.materials[static_cast<size_t>(material)].normal_texture.uv_set);
    if (mesh.uvs[set].empty()) {
      warn("has a normal map but no texture coordinates for it; the map is left out");
      return;
    }
    mesh.tangents = generate_tangents(mesh, set);
  }

  const Document& d_;
  const tinygltf::Primitive& from_;
  Scene& scene_;
  std::string where_;
};

}  // namespace

void import_meshes(const Document& d, Scene& scene, const std::function<bool(float)>& progress) {
  for (size_t i = 0; i < d.model.meshes.size(); ++i) {
    const auto& from = d.model.meshes[i];
    MeshGroup group;
    group.name = from.name;
    for (const double w : from.weights) group.weights.push_back(static_cast<float>(w));
    for (size_t p = 0; p < from.primitives.size(); ++p) {
      Primitive primitive;
      if (PrimitiveImporter(d, from.primitives[p], scene, at("meshes", i) + "." + at("primitives", p)).run(primitive)) group.primitives.push_back(std::move(primitive));
    }
    scene.meshes.push_back(std::move(group));
    if (!progress(static_cast<float>(i + 1) / static_cast<float>(d.model.meshes.size()))) throw Unusable{"loading was cancelled"};
  }
}

}  // namespace etendue::scene::gltf
