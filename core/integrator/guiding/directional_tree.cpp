#include "integrator/guiding/directional_tree.h"

#include <algorithm>

namespace etendue::guiding {
namespace {

// Selects the second of two parts with the masses `first` and `second`, and stretches u to that part.
bool select_part(float first, float second, float& u) {
  const float split = first / (first + second);
  const bool is_second = u >= split;
  u = is_second ? (u - split) / (1 - split) : u / split;
  u = std::min(u, kOneMinusEpsilon);
  return is_second;
}

}  // namespace

void DirectionalTree::sum_up() {
  for (size_t i = nodes_.size(); i-- > 0;)
    for (size_t q = 0; q < 4; ++q)
      if (const uint32_t child = nodes_[i].child[q]; child != 0) nodes_[i].sums[q] = nodes_[child].total();
}

float DirectionalTree::pdf(Vec2 p) const {
  const Node* node = nodes_.data();
  float density = 1;
  for (;;) {
    const size_t quarter = descend(p);
    const float sum = node->sums[quarter];
    if (!(sum > 0)) return 0;
    density *= 4 * sum / node->total();
    if (node->child[quarter] == 0) return density;
    node = &nodes_[node->child[quarter]];
  }
}

Vec2 DirectionalTree::sample(Vec2 u) const {
  const Node* node = nodes_.data();
  Vec2 corner(0);
  float size = 1;
  for (;;) {
    const auto& sums = node->sums;
    const size_t x = select_part(sums[0] + sums[2], sums[1] + sums[3], u.x);
    const size_t y = select_part(sums[x], sums[x + 2], u.y);
    size *= 0.5f;
    corner += size * Vec2(static_cast<float>(x), static_cast<float>(y));
    const uint32_t child = node->child[x + 2 * y];
    if (child == 0) return glm::min(corner + size * u, Vec2(kOneMinusEpsilon));
    node = &nodes_[child];
  }
}

DirectionalTree DirectionalTree::refined(float threshold) const {
  DirectionalTree tree;
  if (total() > 0) tree.divide(*this, 0, 0, 0, threshold * total(), 1);
  return tree;
}

// Divides the quarters of `node` that hold more than `smallest`. They hold what the quarters of `source_node` hold, or a
// quarter of `cell` if that node is kNone.
void DirectionalTree::divide(const DirectionalTree& source, uint32_t source_node, uint32_t node, float cell,
                             float smallest, int depth) {
  constexpr uint32_t kNone = UINT32_MAX;
  if (depth >= kMaxDepth) return;
  for (size_t q = 0; q < 4; ++q) {
    const bool has_source = source_node != kNone;
    const float sum = has_source ? source.nodes_[source_node].sums[q] : 0.25f * cell;
    if (!(sum > smallest)) continue;
    const uint32_t below = has_source ? source.nodes_[source_node].child[q] : 0;
    const auto added = static_cast<uint32_t>(nodes_.size());
    nodes_.emplace_back();
    nodes_[node].child[q] = added;
    divide(source, below != 0 ? below : kNone, added, sum, smallest, depth + 1);
  }
}

bool DirectionalTree::assign(std::vector<Node> nodes) {
  if (nodes.empty()) return false;
  for (size_t i = 0; i < nodes.size(); ++i)
    for (const uint32_t child : nodes[i].child)
      if (child != 0 && (child <= i || child >= nodes.size())) return false;
  nodes_ = std::move(nodes);
  return true;
}

}  // namespace etendue::guiding
