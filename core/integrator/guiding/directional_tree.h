// Distributions of directions: quadtrees over the square to which the sphere maps with equal areas. [Müller et al. 2017]
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/fast_trigonometry.h"
#include "base/vec.h"
#include "base/warp.h"

namespace etendue::guiding {

// The inverse of square_to_sphere.
inline Vec2 sphere_to_square(const Vec3& w) {
  const float turn = fast_atan2(w.y, w.x) * (0.5f * kInvPi);
  return {std::clamp(0.5f - 0.5f * w.z, 0.0f, kOneMinusEpsilon),
          std::clamp(turn < 0 ? turn + 1 : turn, 0.0f, kOneMinusEpsilon)};
}

// The quarters of a cell: quarter x + 2 y is at (x, y). `child` is the index of the node that divides it; 0: none.
// Children follow their parents.
struct QuadtreeNode {
  std::array<float, 4> values{};
  std::array<uint32_t, 4> child{};

  float total() const { return (values[0] + values[1]) + (values[2] + values[3]); }

  // The quarter that contains p, which becomes the position in that quarter.
  static size_t descend(Vec2& p) {
    p *= 2.0f;
    const bool x = p.x >= 1, y = p.y >= 1;
    p -= Vec2(x ? 1.0f : 0.0f, y ? 1.0f : 0.0f);
    return size_t{x} + 2 * size_t{y};
  }
};
inline constexpr int kMaxQuadtreeDepth = 12;

// The square is also divided into 4 x 4 equal cells, those of the second level of a full quadtree. The index of a cell
// consists of the quarters that lead to it, the first one in the highest bits.
inline constexpr int kCellDepth = 2;
inline constexpr size_t kCells = size_t{1} << (2 * kCellDepth);
// The cell that contains p, which becomes the position in that cell.
inline size_t descend_to_cell(Vec2& p) {
  size_t cell = 0;
  for (int depth = 0; depth < kCellDepth; ++depth) cell = 4 * cell + QuadtreeNode::descend(p);
  return cell;
}
// The lower corner of a cell.
inline Vec2 cell_corner(size_t cell) {
  Vec2 corner(0);
  for (int depth = 0; depth < kCellDepth; ++depth) {
    const size_t quarter = cell >> (2 * depth) & 3;
    corner = 0.5f * (corner + Vec2(static_cast<float>(quarter & 1), static_cast<float>(quarter >> 1)));
  }
  return corner;
}

// Whether the nodes form a quadtree.
bool is_quadtree(const std::vector<QuadtreeNode>& nodes);

// Selects the second of two parts with the masses `first` and `second`, of which one is positive, and stretches u to
// that part.
inline bool select_part(float first, float second, float& u) {
  const float split = first / (first + second);
  const bool is_second = u >= split;
  u = std::min(is_second ? (u - split) / (1 - split) : u / split, kOneMinusEpsilon);
  return is_second;
}
// Selects one of four quarters by their masses, and stretches u to it.
inline size_t select_quarter(const float* masses, Vec2& u) {
  const size_t x = select_part(masses[0] + masses[2], masses[1] + masses[3], u.x);
  const size_t y = select_part(masses[x], masses[x + 2], u.y);
  return x + 2 * y;
}

class DirectionalSums;

// A piecewise constant density on the unit square. The values of a node are the probabilities of its quarters.
class DirectionalDistribution {
 public:
  // Uniform.
  DirectionalDistribution() : DirectionalDistribution(std::vector<QuadtreeNode>{{{0.25f, 0.25f, 0.25f, 0.25f}, {}}}) {}
  // `nodes` must be a quadtree.
  explicit DirectionalDistribution(std::vector<QuadtreeNode> nodes);

  // The density of `sample` at a point, per unit area of the square.
  float pdf(Vec2 p) const {
    float density = 1;
    for (const QuadtreeNode* node = nodes_.data();;) {
      const size_t quarter = QuadtreeNode::descend(p);
      density *= 4 * node->values[quarter];
      if (node->child[quarter] == 0) return density;
      node = &nodes_[node->child[quarter]];
    }
  }
  // A point for u uniform in the square.
  Vec2 sample(Vec2 u) const;

  // The probabilities of the 4 x 4 cells.
  const std::array<float, kCells>& cell_probabilities() const { return cell_probabilities_; }
  // A point in a cell, with the density of `sample` given that its point lies there.
  Vec2 sample_in_cell(size_t cell, Vec2 u) const;

  // Empty sums whose cells have a probability of at most `threshold` each, where the depth allows it.
  DirectionalSums cells(float threshold) const;

  const std::vector<QuadtreeNode>& nodes() const { return nodes_; }

 private:
  // A point of the square that the node divides.
  Vec2 sample_below(const QuadtreeNode* node, Vec2 u) const;

  std::vector<QuadtreeNode> nodes_;
  alignas(64) std::array<float, kCells> cell_probabilities_;
};

// Sums over the cells of a quadtree.
class DirectionalSums {
 public:
  // One cell per quarter of the square.
  DirectionalSums() : nodes_(1) {}
  explicit DirectionalSums(std::vector<QuadtreeNode> nodes) : nodes_(std::move(nodes)) {}

  // Adds a value to the cell of a point.
  void add(Vec2 p, float value) {
    for (QuadtreeNode* node = nodes_.data();;) {
      const size_t quarter = QuadtreeNode::descend(p);
      if (node->child[quarter] == 0) {
        node->values[quarter] += value;
        return;
      }
      node = &nodes_[node->child[quarter]];
    }
  }

  // The distribution that the sums of so many records of equal weight support: cells with few records are joined, and
  // every quarter of a cell counts one record more, so that the density is positive.
  DirectionalDistribution distribution(float records) const;

  const std::vector<QuadtreeNode>& nodes() const { return nodes_; }

 private:
  std::vector<QuadtreeNode> nodes_;
};

}  // namespace etendue::guiding
