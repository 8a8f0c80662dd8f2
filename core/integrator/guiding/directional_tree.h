// A distribution of directions: a quadtree over the square to which the sphere maps with equal areas. [Müller et al. 2017]
#pragma once
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

// A piecewise constant function on the unit square. Cells are quarters of quarters; a cell that holds a large fraction
// of the integral is divided.
class DirectionalTree {
 public:
  // The quarters of a cell: quarter x + 2 y is at (x, y). `child` is the index of the node that divides it; 0: none.
  // Children follow their parents.
  struct Node {
    std::array<float, 4> sums{};
    std::array<uint32_t, 4> child{};

    float total() const { return (sums[0] + sums[1]) + (sums[2] + sums[3]); }
  };
  static constexpr int kMaxDepth = 12;

  // One cell per quarter of the square.
  DirectionalTree() : nodes_(1) {}

  // Adds a value to the cell of a point. `sum_up` makes it part of the function.
  void add(Vec2 p, float value) {
    Node* node = nodes_.data();
    for (;;) {
      const size_t quarter = descend(p);
      if (node->child[quarter] == 0) {
        node->sums[quarter] += value;
        return;
      }
      node = &nodes_[node->child[quarter]];
    }
  }
  // Computes the sums of divided cells. To be called once, after the last value.
  void sum_up();

  // The integral over the square; 0 if the tree has no values.
  float total() const { return nodes_[0].total(); }
  // The density of `sample` at a point, per unit area of the square. `total` must be positive.
  float pdf(Vec2 p) const;
  // A point distributed as the function, for u uniform in the square. `total` must be positive.
  Vec2 sample(Vec2 u) const;

  // A tree without values whose cells hold at most a fraction `threshold` of this function, where the depth allows it.
  DirectionalTree refined(float threshold) const;

  const std::vector<Node>& nodes() const { return nodes_; }
  // False if the nodes do not form a tree, which is then unchanged.
  bool assign(std::vector<Node> nodes);

 private:
  // The quarter that contains p, which becomes the position in that quarter.
  static size_t descend(Vec2& p) {
    p *= 2.0f;
    const bool x = p.x >= 1, y = p.y >= 1;
    p -= Vec2(x ? 1.0f : 0.0f, y ? 1.0f : 0.0f);
    return size_t{x} + 2 * size_t{y};
  }
  void divide(const DirectionalTree& source, uint32_t source_node, uint32_t node, float cell, float smallest,
              int depth);

  std::vector<Node> nodes_;
};

}  // namespace etendue::guiding
