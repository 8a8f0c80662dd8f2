#include "geometry/tangents.h"

#include <bit>
#include <span>
#include <unordered_map>

#include "base/hash.h"
#include "geometry/mesh_build.h"

namespace etendue {
namespace {

constexpr uint32_t kNone = 0xffffffffU;

// The direction of increasing u on a triangle, and whether the texture is mirrored on it.
struct Gradient {
  Vec3 direction{0};
  bool mirrored = false, valid = false;
};

class TangentBuilder {
 public:
  TangentBuilder(Mesh& mesh, size_t set, const glm::mat2& to_texture)
      : mesh_(mesh), set_(set), to_texture_(to_texture) {}

  std::vector<uint32_t> build() {
    weld();
    for (const Triangle& t : mesh_.triangles) gradients_.push_back(gradient_of(t));
    collect_corners();
    groups_.assign(mesh_.triangles.size() * 3, kNone);
    for (size_t id = 0; id + 1 < first_corner_.size(); ++id) group_corners(id);
    return assign();
  }

 private:
  Vec2 uv(uint32_t vertex) const { return to_texture_ * mesh_.uvs[set_][vertex]; }

  // Maps vertices with equal position, normal and texture coordinates to one representative.
  void weld() {
    const size_t n = mesh_.positions.size();
    const size_t slots = std::bit_ceil(2 * n + 2);
    std::vector<uint32_t> table(slots, kNone);
    welded_.resize(n);
    const auto same = [&](uint32_t a, uint32_t b) {
      return mesh_.positions[a] == mesh_.positions[b] && mesh_.normals[a] == mesh_.normals[b] &&
             mesh_.uvs[set_][a] == mesh_.uvs[set_][b];
    };
    for (uint32_t v = 0; v < n; ++v) {
      const Vec2& t = mesh_.uvs[set_][v];
      const uint64_t hash =
          hash_position(mesh_.positions[v]) ^ mix_bits(hash_position(mesh_.normals[v]) + hash_position(Vec3(t, 0)));
      size_t slot = hash & (slots - 1);
      while (table[slot] != kNone && !same(table[slot], v)) slot = (slot + 1) & (slots - 1);
      if (table[slot] == kNone) table[slot] = v;
      welded_[v] = table[slot];
    }
  }

  Gradient gradient_of(const Triangle& t) const {
    const Vec3 e1 = mesh_.positions[t[1]] - mesh_.positions[t[0]], e2 = mesh_.positions[t[2]] - mesh_.positions[t[0]];
    const Vec2 d1 = uv(t[1]) - uv(t[0]), d2 = uv(t[2]) - uv(t[0]);
    const float area = d1.x * d2.y - d1.y * d2.x;
    Gradient gradient;
    gradient.mirrored = area <= 0;
    gradient.direction = normalize_or((e1 * d2.y - e2 * d1.y) * (area < 0 ? -1.0f : 1.0f), Vec3(0));
    gradient.valid = area != 0 && std::isfinite(area) && length_squared(gradient.direction) > 0;
    return gradient;
  }

  uint32_t vertex_at(size_t corner) const { return mesh_.triangles[corner / 3][corner % 3]; }
  uint32_t neighbour_at(size_t corner, size_t step) const {
    return welded_[mesh_.triangles[corner / 3][(corner % 3 + step) % 3]];
  }

  // Sorts corners by their welded vertex (counting sort).
  void collect_corners() {
    first_corner_.assign(mesh_.positions.size() + 1, 0);
    const size_t corners = mesh_.triangles.size() * 3;
    for (size_t c = 0; c < corners; ++c) ++first_corner_[welded_[vertex_at(c)] + 1];
    for (size_t i = 1; i < first_corner_.size(); ++i) first_corner_[i] += first_corner_[i - 1];
    corners_.resize(corners);
    std::vector<size_t> next(first_corner_.begin(), first_corner_.end() - 1);
    for (size_t c = 0; c < corners; ++c) corners_[next[welded_[vertex_at(c)]]++] = c;
  }

  // Partitions the corners around a vertex into groups that are connected by edges and have the same handedness.
  void group_corners(size_t id) {
    const std::span<const size_t> corners(corners_.data() + first_corner_[id],
                                          first_corner_[id + 1] - first_corner_[id]);
    if (corners.empty()) return;
    std::vector<size_t> parent(corners.size());
    for (size_t i = 0; i < parent.size(); ++i) parent[i] = i;
    const auto root = [&](size_t i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    // An edge that leaves the vertex in one triangle enters it in the adjacent triangle.
    std::vector<std::pair<uint32_t, size_t>> leaving, entering;
    for (size_t i = 0; i < corners.size(); ++i) {
      leaving.emplace_back(neighbour_at(corners[i], 1), i);
      entering.emplace_back(neighbour_at(corners[i], 2), i);
    }
    std::sort(leaving.begin(), leaving.end());
    std::sort(entering.begin(), entering.end());
    for (size_t l = 0, e = 0; l < leaving.size() && e < entering.size();) {
      if (leaving[l].first != entering[e].first) {
        ++(leaving[l].first < entering[e].first ? l : e);
        continue;
      }
      const Gradient &a = gradients_[corners[leaving[l].second] / 3], &b = gradients_[corners[entering[e].second] / 3];
      if (a.valid && b.valid && a.mirrored == b.mirrored) parent[root(leaving[l].second)] = root(entering[e].second);
      ++l;
      ++e;
    }
    average(corners, [&](size_t i) { return root(i); });
  }

  template <class Root>
  // Adds the mean tangent of each group and assigns it to its corners.
  void average(std::span<const size_t> corners, Root&& root) {
    std::vector<Vec3> sums(corners.size(), Vec3(0));
    const Vec3& normal = mesh_.normals[vertex_at(corners[0])];
    for (size_t i = 0; i < corners.size(); ++i)
      if (gradients_[corners[i] / 3].valid) sums[root(i)] += contribution(corners[i], normal);
    std::vector<uint32_t> group(corners.size(), kNone);
    uint32_t any = kNone;
    for (size_t i = 0; i < corners.size(); ++i) {
      const Gradient& gradient = gradients_[corners[i] / 3];
      uint32_t& g = group[root(i)];
      if (!gradient.valid) continue;
      if (g == kNone) g = any = add_tangent(sums[root(i)], normal, gradient.mirrored);
      groups_[corners[i]] = g;
    }
    // Corners of triangles without texture gradient join another group of the vertex.
    for (const size_t c : corners) {
      if (groups_[c] != kNone) continue;
      if (any == kNone) any = add_tangent(Vec3(0), normal, true);
      groups_[c] = any;
    }
  }

  // The tangent of a triangle, weighted by the angle at the corner.
  Vec3 contribution(size_t corner, const Vec3& normal) const {
    const auto flat = [&](const Vec3& v) { return normalize_or(v - normal * glm::dot(normal, v), Vec3(0)); };
    const Triangle& t = mesh_.triangles[corner / 3];
    const Vec3& p = mesh_.positions[t[corner % 3]];
    const Vec3 a = flat(mesh_.positions[t[(corner + 1) % 3]] - p), b = flat(mesh_.positions[t[(corner + 2) % 3]] - p);
    return flat(gradients_[corner / 3].direction) * std::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f));
  }

  uint32_t add_tangent(const Vec3& sum, const Vec3& normal, bool mirrored) {
    const Vec3 axis = std::abs(normal.x) < 0.9f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 tangent = normalize_or(sum, normalize_or(axis - normal * glm::dot(normal, axis), axis));
    // In glTF, v increases downwards, but the y axis of a normal map points up. Coordinates that appear mirrored
    // therefore have the sign +1.
    tangents_.emplace_back(tangent, mirrored ? 1.0f : -1.0f);
    return static_cast<uint32_t>(tangents_.size() - 1);
  }

  // Sets the tangents of all vertices and splits vertices with several groups; returns the originals of the copies.
  std::vector<uint32_t> assign() {
    std::vector<uint32_t> owner(mesh_.positions.size(), kNone), copies;
    std::unordered_map<uint64_t, uint32_t> split;
    for (size_t c = 0; c < groups_.size(); ++c) {
      uint32_t& vertex = mesh_.triangles[c / 3][c % 3];
      uint32_t& first = owner[vertex];
      if (first == kNone) first = groups_[c];
      if (first == groups_[c]) continue;
      const auto next = static_cast<uint32_t>(owner.size() + copies.size());
      const auto [place, added] = split.try_emplace(uint64_t{vertex} << 32 | groups_[c], next);
      if (added) copies.push_back(vertex);
      vertex = place->second;
    }
    mesh_.tangents.assign(owner.size(), Vec4(1, 0, 0, 1));
    for (size_t v = 0; v < owner.size(); ++v)
      if (owner[v] != kNone) mesh_.tangents[v] = tangents_[owner[v]];
    append_copies(mesh_, copies);
    for (const auto& [key, vertex] : split) mesh_.tangents[vertex] = tangents_[static_cast<uint32_t>(key)];
    return copies;
  }

  Mesh& mesh_;
  const size_t set_;
  const glm::mat2 to_texture_;
  std::vector<uint32_t> welded_;
  std::vector<Gradient> gradients_;
  std::vector<size_t> first_corner_, corners_;
  std::vector<uint32_t> groups_;  // by corner
  std::vector<Vec4> tangents_;    // by group
};

}  // namespace

std::vector<uint32_t> generate_tangents(Mesh& mesh, size_t set, const glm::mat2& to_texture) {
  return TangentBuilder(mesh, set, to_texture).build();
}

}  // namespace etendue
