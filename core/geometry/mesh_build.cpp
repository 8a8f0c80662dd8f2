#include "geometry/mesh_build.h"

#include <bit>
#include <unordered_map>

#include "base/hash.h"

namespace etendue {
namespace {

// Which of the three corners has the smallest hash: where all rotations of a triangle agree to begin.
size_t first_corner(const std::array<uint64_t, 3>& h) {
  const size_t smaller = h[1] < h[0] ? 1 : 0;
  return h[2] < h[smaller] ? 2 : smaller;
}

bool same_place(const Mesh& mesh, const Triangle& a, const Triangle& b) {
  for (size_t turn = 0; turn < 3; ++turn) {
    bool same = true;
    for (size_t k = 0; k < 3 && same; ++k) same = mesh.positions[a[k]] == mesh.positions[b[(k + turn) % 3]];
    if (same) return true;
  }
  return false;
}

// A set that may say yes for what it does not hold, but says it seldom and fast.
class Filter {
 public:
  explicit Filter(size_t entries)
      : bits_(std::bit_ceil(std::clamp<size_t>(entries * 16, 1024, size_t{1} << 27)) / 64) {}

  // Whether it was there, or looked like it.
  bool insert(uint64_t hash) {
    uint64_t& word = bits_[(hash >> 6) & (bits_.size() - 1)];
    const uint64_t bit = uint64_t{1} << (hash & 63);
    const bool there = word & bit;
    word |= bit;
    return there;
  }
  bool contains(uint64_t hash) const { return bits_[(hash >> 6) & (bits_.size() - 1)] >> (hash & 63) & 1; }

 private:
  std::vector<uint64_t> bits_;
};

template <class T>
void append(std::vector<T>& values, const std::vector<uint32_t>& vertices) {
  if (values.empty()) return;
  values.reserve(values.size() + vertices.size() + 1);
  for (const uint32_t v : vertices) values.push_back(T(values[v]));
}

template <class T>
void gather(std::vector<T>& values, const std::vector<uint32_t>& vertices) {
  if (values.empty()) return;
  std::vector<T> chosen;
  chosen.reserve(vertices.size() + 1);
  for (const uint32_t v : vertices) chosen.push_back(values[v]);
  values = std::move(chosen);
}

Vec3 area_normal(const Mesh& mesh, const Triangle& t) {
  const Vec3& p = mesh.positions[t[0]];
  return glm::cross(mesh.positions[t[1]] - p, mesh.positions[t[2]] - p);
}

}  // namespace

uint64_t hash_position(const Vec3& p) {
  // Adding zero turns -0 into +0.
  const auto bits = [](float x) { return uint64_t{std::bit_cast<uint32_t>(x + 0.0f)}; };
  return mix_bits(bits(p.x) << 32 | bits(p.y)) + mix_bits(bits(p.z) + uint64_t{0x9e3779b97f4a7c15});
}

size_t drop_non_finite(Mesh& mesh) {
  const auto wrong = [](const Vec3& p) { return !is_finite(p); };
  if (std::none_of(mesh.positions.begin(), mesh.positions.end(), wrong)) return 0;
  const size_t dropped = std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return wrong(mesh.positions[t[0]]) || wrong(mesh.positions[t[1]]) || wrong(mesh.positions[t[2]]);
  });
  const auto right = std::find_if_not(mesh.positions.begin(), mesh.positions.end(), wrong);
  const Vec3 place = right == mesh.positions.end() ? Vec3(0) : *right;
  std::replace_if(mesh.positions.begin(), mesh.positions.end(), wrong, place);
  return dropped;
}

size_t drop_degenerate(Mesh& mesh) {
  // The normal of the triangle scaled to size one has a rounding error of about 1e-7.
  constexpr float kLost = 1e-15f;
  const auto degenerate = [&](const Triangle& t) {
    const Vec3& p = mesh.positions[t[0]];
    const Vec3 a = mesh.positions[t[1]] - p, b = mesh.positions[t[2]] - p;
    const float size = std::max(max_component(glm::abs(a)), max_component(glm::abs(b)));
    if (!(size > 0) || !std::isfinite(size)) return true;
    return !(length_squared(glm::cross(a / size, b / size)) > kLost) || !is_finite(glm::cross(a, b));
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
  // Exact comparison is for the few that a cheap look cannot tell apart.
  Filter seen(mesh.triangles.size());
  std::vector<uint64_t> suspects;
  for (const Triangle& t : mesh.triangles)
    if (const uint64_t hash = hash_of(t); seen.insert(hash)) suspects.push_back(hash);
  if (suspects.empty()) return 0;
  Filter suspected(suspects.size());
  for (const uint64_t hash : suspects) suspected.insert(hash);
  std::unordered_multimap<uint64_t, Triangle> kept;
  return std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const uint64_t hash = hash_of(t);
    if (!suspected.contains(hash)) return false;
    const auto [first, last] = kept.equal_range(hash);
    for (auto it = first; it != last; ++it)
      if (same_place(mesh, it->second, t)) return true;
    kept.emplace(hash, t);
    return false;
  });
}

size_t repair_normals(Mesh& mesh) {
  std::vector<uint32_t> wrong;
  for (uint32_t i = 0; i < mesh.normals.size(); ++i) {
    Vec3& n = mesh.normals[i];
    const float squared = length_squared(n);
    if (std::abs(squared - 1) < 1e-5f) continue;
    if (squared > 0 && std::isfinite(squared))
      n /= std::sqrt(squared);
    else
      wrong.push_back(i), n = Vec3(0);
  }
  if (wrong.empty()) return 0;
  std::vector<bool> is_wrong(mesh.normals.size(), false);
  for (const uint32_t i : wrong) is_wrong[i] = true;
  for (const Triangle& t : mesh.triangles)
    for (const uint32_t v : t)
      if (is_wrong[v]) mesh.normals[v] += area_normal(mesh, t);
  for (const uint32_t i : wrong) mesh.normals[i] = normalize_or(mesh.normals[i], Vec3(0, 1, 0));
  return wrong.size();
}

void append_copies(Mesh& mesh, const std::vector<uint32_t>& vertices) {
  append(mesh.positions, vertices);
  append(mesh.normals, vertices);
  append(mesh.tangents, vertices);
  append(mesh.uvs[0], vertices);
  append(mesh.uvs[1], vertices);
  append(mesh.colors, vertices);
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
  gather(mesh.positions, sources);
  gather(mesh.tangents, sources);
  gather(mesh.uvs[0], sources);
  gather(mesh.uvs[1], sources);
  gather(mesh.colors, sources);
  mesh.normals = std::move(normals);
  return sources;
}

}  // namespace etendue
