#include "geometry/mesh_build.h"

#include <bit>
#include <unordered_map>

#include "base/hash.h"

namespace etendue {
namespace {

// The index of the smallest hash, which identifies the same vertex in all rotations of a triangle.
size_t first_corner(const std::array<uint64_t, 3>& h) {
  const size_t smaller = h[1] < h[0] ? 1 : 0;
  return h[2] < h[smaller] ? 2 : smaller;
}

// Whether two triangles have the same vertices in the same cyclic order.
bool coincide(const Mesh& mesh, const Triangle& a, const Triangle& b) {
  for (size_t rotation = 0; rotation < 3; ++rotation) {
    bool same = true;
    for (size_t k = 0; k < 3 && same; ++k) same = mesh.positions[a[k]] == mesh.positions[b[(k + rotation) % 3]];
    if (same) return true;
  }
  return false;
}

// A set of hashes with few false positives and no false negatives (Bloom filter with one hash function).
class BloomFilter {
 public:
  explicit BloomFilter(size_t entries)
      : bits_(std::bit_ceil(std::clamp<size_t>(entries * 16, 1024, size_t{1} << 27)) / 64) {}

  // Returns whether the set contained the hash, up to false positives.
  bool insert(uint64_t hash) {
    uint64_t& word = bits_[(hash >> 6) & (bits_.size() - 1)];
    const uint64_t bit = uint64_t{1} << (hash & 63);
    const bool contained = word & bit;
    word |= bit;
    return contained;
  }
  bool contains(uint64_t hash) const { return bits_[(hash >> 6) & (bits_.size() - 1)] >> (hash & 63) & 1; }

 private:
  std::vector<uint64_t> bits_;
};

template <class T>
void append_elements(std::vector<T>& values, const std::vector<uint32_t>& vertices) {
  if (values.empty()) return;
  values.reserve(values.size() + vertices.size() + 1);
  for (const uint32_t v : vertices) values.push_back(T(values[v]));
}

template <class T>
void select_elements(std::vector<T>& values, const std::vector<uint32_t>& vertices) {
  if (values.empty()) return;
  std::vector<T> selected;
  selected.reserve(vertices.size() + 1);
  for (const uint32_t v : vertices) selected.push_back(values[v]);
  values = std::move(selected);
}

// The normal of a triangle, with twice its area as length.
Vec3 area_normal(const Mesh& mesh, const Triangle& t) {
  const Vec3& p = mesh.positions[t[0]];
  return glm::cross(mesh.positions[t[1]] - p, mesh.positions[t[2]] - p);
}

}  // namespace

uint64_t hash_position(const Vec3& p) {
  // Adding 0 turns -0 into 0.
  const auto bits = [](float x) { return uint64_t{std::bit_cast<uint32_t>(x + 0.0f)}; };
  return mix_bits(bits(p.x) << 32 | bits(p.y)) + mix_bits(bits(p.z) + uint64_t{0x9e3779b97f4a7c15});
}

size_t drop_non_finite(Mesh& mesh) {
  const auto invalid = [](const Vec3& p) { return !is_finite(p); };
  if (std::none_of(mesh.positions.begin(), mesh.positions.end(), invalid)) return 0;
  const size_t dropped = std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return invalid(mesh.positions[t[0]]) || invalid(mesh.positions[t[1]]) || invalid(mesh.positions[t[2]]);
  });
  const auto valid = std::find_if_not(mesh.positions.begin(), mesh.positions.end(), invalid);
  const Vec3 replacement = valid == mesh.positions.end() ? Vec3(0) : *valid;
  std::replace_if(mesh.positions.begin(), mesh.positions.end(), invalid, replacement);
  return dropped;
}

size_t drop_degenerate(Mesh& mesh) {
  // The normal of a triangle scaled to size 1 has a rounding error of about 1e-7; this bounds its squared length.
  constexpr float kMinSquaredLength = 1e-15f;
  const auto degenerate = [&](const Triangle& t) {
    const Vec3& p = mesh.positions[t[0]];
    const Vec3 a = mesh.positions[t[1]] - p, b = mesh.positions[t[2]] - p;
    const float size = std::max(max_component(glm::abs(a)), max_component(glm::abs(b)));
    if (!(size > 0) || !std::isfinite(size)) return true;
    return !(length_squared(glm::cross(a / size, b / size)) > kMinSquaredLength) || !is_finite(glm::cross(a, b));
  };
  return std::erase_if(mesh.triangles, degenerate);
}

size_t drop_duplicates(Mesh& mesh) {
  std::vector<uint64_t> vertex_hashes;
  vertex_hashes.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) vertex_hashes.push_back(hash_position(p));
  const auto hash_of = [&](const Triangle& t) {
    const std::array<uint64_t, 3> h{vertex_hashes[t[0]], vertex_hashes[t[1]], vertex_hashes[t[2]]};
    const size_t k = first_corner(h);
    return mix_bits(h[k] + mix_bits(h[(k + 1) % 3] + mix_bits(h[(k + 2) % 3])));
  };
  // The filter finds candidates; only these are compared exactly.
  BloomFilter hashes(mesh.triangles.size());
  std::vector<uint64_t> candidates;
  for (const Triangle& t : mesh.triangles)
    if (const uint64_t hash = hash_of(t); hashes.insert(hash)) candidates.push_back(hash);
  if (candidates.empty()) return 0;
  BloomFilter candidate_hashes(candidates.size());
  for (const uint64_t hash : candidates) candidate_hashes.insert(hash);
  std::unordered_multimap<uint64_t, Triangle> distinct;
  return std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const uint64_t hash = hash_of(t);
    if (!candidate_hashes.contains(hash)) return false;
    const auto [first, last] = distinct.equal_range(hash);
    for (auto it = first; it != last; ++it)
      if (coincide(mesh, it->second, t)) return true;
    distinct.emplace(hash, t);
    return false;
  });
}

size_t repair_normals(Mesh& mesh) {
  std::vector<uint32_t> invalid;
  for (uint32_t i = 0; i < mesh.normals.size(); ++i) {
    Vec3& n = mesh.normals[i];
    const float squared = length_squared(n);
    if (std::abs(squared - 1) < 1e-5f) continue;
    if (squared > 0 && std::isfinite(squared)) {
      n /= std::sqrt(squared);
    } else {
      invalid.push_back(i);
      n = Vec3(0);
    }
  }
  if (invalid.empty()) return 0;
  std::vector<bool> is_invalid(mesh.normals.size(), false);
  for (const uint32_t i : invalid) is_invalid[i] = true;
  for (const Triangle& t : mesh.triangles)
    for (const uint32_t v : t)
      if (is_invalid[v]) mesh.normals[v] += area_normal(mesh, t);
  for (const uint32_t i : invalid) mesh.normals[i] = normalize_or(mesh.normals[i], Vec3(0, 1, 0));
  return invalid.size();
}

void append_copies(Mesh& mesh, const std::vector<uint32_t>& vertices) {
  append_elements(mesh.positions, vertices);
  append_elements(mesh.normals, vertices);
  append_elements(mesh.tangents, vertices);
  append_elements(mesh.uvs[0], vertices);
  append_elements(mesh.uvs[1], vertices);
  append_elements(mesh.colors, vertices);
}

std::vector<uint32_t> split_into_flat_triangles(Mesh& mesh) {
  std::vector<uint32_t> sources;
  std::vector<Vec3> normals;
  sources.reserve(mesh.triangles.size() * 3);
  normals.reserve(mesh.triangles.size() * 3);
  for (Triangle& t : mesh.triangles) {
    const auto first = static_cast<uint32_t>(sources.size());
    sources.insert(sources.end(), t.begin(), t.end());
    normals.insert(normals.end(), 3, normalize_or(area_normal(mesh, t), Vec3(0, 1, 0)));
    t = {first, first + 1, first + 2};
  }
  select_elements(mesh.positions, sources);
  select_elements(mesh.tangents, sources);
  select_elements(mesh.uvs[0], sources);
  select_elements(mesh.uvs[1], sources);
  select_elements(mesh.colors, sources);
  mesh.normals = std::move(normals);
  return sources;
}

}  // namespace etendue
