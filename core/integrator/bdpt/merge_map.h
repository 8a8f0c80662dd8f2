// Vertices of light subpaths, found by their position, that camera subpaths are merged with.
//                                                                                            [Georgiev et al. 2012]
//
// The vertices are sorted by the cells of a grid, whose edges are twice the radius long: a ball touches eight cells.
// Cells are found by a hash. Pieces of the range of hashes are built in parallel.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/hash.h"
#include "base/vec.h"
#include "spectrum/rgb.h"
#include "transport/mis/mis_chain.h"

namespace etendue::integrator {

struct MergeVertex {
  Vec3 position{0};
  float pdf = 1;  // MisVertex::pdf
  Vec3 wo{0};     // towards the previous vertex
  float weighted_sum = 0;
  Vec3 normal{0};       // of the surface
  uint32_t cell = 0;    // the hash of its cell
  Rgb flux{0};          // of the light subpath that arrives
  uint16_t length = 0;  // edges from the light
  uint8_t state = 0;    // of the path class
  bool connectible = false;

  transport::MisVertex mis() const {
    transport::MisVertex vertex;
    vertex.pdf = pdf;
    vertex.weighted_sum = weighted_sum;
    vertex.connection = connectible ? 1 : 0;
    return vertex;
  }
};

class MergeMap {
 public:
  static constexpr int kPieces = 32;

  // Vertices by piece.
  using Lists = std::array<std::vector<MergeVertex>, kPieces>;
  using Cell = glm::ivec3;

  // Starts an empty map. `radius` in metres; `paths` is the number of light subpaths.
  void begin(float radius, int paths) {
    radius2_ = radius * radius;
    cells_per_metre_ = 0.5f / radius;
    density_ = kPi * radius2_ * static_cast<float>(paths);
    for (Piece& piece : pieces_) piece = {};
  }

  // eta, the mean number of merges per density of vertices, m^2 (mis_chain.h).
  float density() const { return density_; }
  // The factor of the sum over merges, 1/m^2.
  float normalization() const { return 1 / density_; }

  // Divides the vertices of a task into lists.
  void divide(std::span<MergeVertex> vertices, Lists& lists) const {
    std::array<size_t, kPieces> counts{};
    for (MergeVertex& v : vertices) {
      v.cell = hash_of(cell_of(v.position * cells_per_metre_));
      ++counts[piece_of(v.cell)];
    }
    for (size_t i = 0; i < kPieces; ++i) {
      lists[i].clear();
      lists[i].reserve(counts[i]);
    }
    for (const MergeVertex& v : vertices) lists[piece_of(v.cell)].push_back(v);
  }

  // Builds a piece from the lists of all tasks, whose memory it releases.
  void build_piece(int index, std::vector<Lists>& lists) {
    const auto number = static_cast<size_t>(index);
    size_t count = 0;
    for (const Lists& list : lists) count += list[number].size();
    Piece& piece = pieces_[number];
    size_t cells = 1;
    while (cells < count) cells *= 2;
    piece.mask = static_cast<uint32_t>(cells - 1);
    piece.first.assign(cells + 1, 0);
    for (const Lists& list : lists)
      for (const MergeVertex& v : list[number]) ++piece.first[(v.cell & piece.mask) + 1];
    for (size_t i = 1; i <= cells; ++i) piece.first[i] += piece.first[i - 1];
    std::vector<uint32_t> next(piece.first.begin(), piece.first.end() - 1);
    piece.vertices.resize(count);
    for (Lists& list : lists) {
      for (const MergeVertex& v : list[number]) piece.vertices[next[v.cell & piece.mask]++] = v;
      std::vector<MergeVertex>().swap(list[number]);
    }
  }

  // Calls found(vertex) for all vertices within the radius, on surfaces of a similar orientation.
  template <class Found>
  void for_each_near(const Vec3& position, const Vec3& normal, Found&& found) const {
    constexpr float kLeastCosine = 0.5f;
    const Cell low = cell_of(position * cells_per_metre_ - 0.5f);
    std::array<uint32_t, 8> visited{};
    for (unsigned k = 0; k < 8; ++k) {
      const uint32_t cell = hash_of(low + Cell(k & 1, k >> 1 & 1, k >> 2));
      visited[k] = cell;
      if (std::find(visited.begin(), visited.begin() + k, cell) != visited.begin() + k) continue;
      const Piece& piece = pieces_[piece_of(cell)];
      if (piece.vertices.empty()) continue;
      const uint32_t slot = cell & piece.mask;
      for (uint32_t i = piece.first[slot]; i < piece.first[slot + 1]; ++i) {
        const MergeVertex& v = piece.vertices[i];
        if (v.cell != cell || length_squared(v.position - position) > radius2_) continue;
        if (std::abs(glm::dot(v.normal, normal)) >= kLeastCosine) found(v);
      }
    }
  }

  size_t size() const {
    size_t count = 0;
    for (const Piece& piece : pieces_) count += piece.vertices.size();
    return count;
  }
  // Calls function(vertex) for every stride-th vertex.
  template <class Function>
  void for_some(size_t stride, Function&& function) const {
    for (const Piece& piece : pieces_)
      for (size_t i = 0; i < piece.vertices.size(); i += stride) function(piece.vertices[i]);
  }
  size_t memory() const {
    size_t bytes = 0;
    for (const Piece& piece : pieces_)
      bytes += piece.vertices.capacity() * sizeof(MergeVertex) + piece.first.capacity() * sizeof(uint32_t);
    return bytes;
  }

 private:
  struct Piece {
    std::vector<MergeVertex> vertices;
    std::vector<uint32_t> first;  // of each slot, and the end
    uint32_t mask = 0;
  };

  // The cell of a position in units of cells.
  static Cell cell_of(const Vec3& position) {
    constexpr float kMost = 2e9f;  // integers have an end
    return Cell(glm::clamp(glm::floor(position), -kMost, kMost));
  }
  static uint32_t hash_of(const Cell& cell) {
    const uint32_t xy = hash_combine(static_cast<uint32_t>(cell.x), static_cast<uint32_t>(cell.y));
    return hash_combine(xy, static_cast<uint32_t>(cell.z));
  }
  // The highest bits select the piece, the lowest ones the slot.
  static size_t piece_of(uint32_t cell) { return cell >> 27; }

  float radius2_ = 0, cells_per_metre_ = 0, density_ = 0;
  std::array<Piece, kPieces> pieces_;
};

}  // namespace etendue::integrator
