#include "integrator/guiding/directional_tree.h"

namespace etendue::guiding {
namespace {

// Cells with fewer records are not divided.
constexpr float kFewestRecords = 8;

// Adds a node for a quarter of another one.
uint32_t add_child(std::vector<QuadtreeNode>& nodes, uint32_t parent, size_t quarter) {
  const auto added = static_cast<uint32_t>(nodes.size());
  nodes.emplace_back();
  nodes[parent].child[quarter] = added;
  return added;
}

// Divides the quarters of `node` that have a probability above `threshold`. The cell has the probability `probability`;
// `source` is its node in the distribution, or null: uniform.
void divide(const std::vector<QuadtreeNode>& sources, const QuadtreeNode* source, float probability, float threshold,
            int depth, uint32_t node, std::vector<QuadtreeNode>& nodes) {
  if (depth >= kMaxQuadtreeDepth) return;
  for (size_t q = 0; q < 4; ++q) {
    const float part = probability * (source ? source->values[q] : 0.25f);
    if (!(part > threshold)) continue;
    const uint32_t below = source ? source->child[q] : 0;
    divide(sources, below != 0 ? &sources[below] : nullptr, part, threshold, depth + 1, add_child(nodes, node, q),
           nodes);
  }
}

// Writes the probabilities of the quarters of `source` to `node`.
void add_probabilities(const std::vector<QuadtreeNode>& sums, uint32_t source, float records, uint32_t node,
                       std::vector<QuadtreeNode>& nodes) {
  const QuadtreeNode& from = sums[source];
  const float total = from.total();
  for (size_t q = 0; q < 4; ++q) {
    const float records_here = total > 0 ? records * from.values[q] / total : 0;
    nodes[node].values[q] = total > 0 ? (records_here + 1) / (records + 4) : 0.25f;
    if (from.child[q] != 0 && records_here >= kFewestRecords)
      add_probabilities(sums, from.child[q], records_here, add_child(nodes, node, q), nodes);
  }
}

}  // namespace

bool is_quadtree(const std::vector<QuadtreeNode>& nodes) {
  for (size_t i = 0; i < nodes.size(); ++i)
    for (const uint32_t child : nodes[i].child)
      if (child != 0 && (child <= i || child >= nodes.size())) return false;
  return !nodes.empty();
}

DirectionalDistribution::DirectionalDistribution(std::vector<QuadtreeNode> nodes) : nodes_(std::move(nodes)) {
  for (size_t cell = 0; cell < kCells; ++cell) {
    const QuadtreeNode* node = nodes_.data();
    float probability = 1;
    for (int depth = kCellDepth - 1; depth >= 0; --depth) {
      const size_t quarter = cell >> (2 * depth) & 3;
      probability *= node ? node->values[quarter] : 0.25f;
      node = node && node->child[quarter] != 0 ? &nodes_[node->child[quarter]] : nullptr;
    }
    cell_probabilities_[cell] = probability;
  }
}

Vec2 DirectionalDistribution::sample_below(const QuadtreeNode* node, Vec2 u) const {
  Vec2 corner(0);
  float size = 1;
  for (;;) {
    const size_t quarter = select_quarter(node->values.data(), u);
    size *= 0.5f;
    corner += size * Vec2(static_cast<float>(quarter & 1), static_cast<float>(quarter >> 1));
    const uint32_t child = node->child[quarter];
    if (child == 0) return glm::min(corner + size * u, Vec2(kOneMinusEpsilon));
    node = &nodes_[child];
  }
}

Vec2 DirectionalDistribution::sample(Vec2 u) const { return sample_below(nodes_.data(), u); }

Vec2 DirectionalDistribution::sample_in_cell(size_t cell, Vec2 u) const {
  const QuadtreeNode* node = nodes_.data();
  for (int depth = kCellDepth - 1; depth >= 0 && node; --depth) {
    const uint32_t child = node->child[cell >> (2 * depth) & 3];
    node = child != 0 ? &nodes_[child] : nullptr;
  }
  constexpr float kCellSize = 1.0f / (1 << kCellDepth);
  const Vec2 inside = node ? sample_below(node, u) : u;
  return glm::min(cell_corner(cell) + kCellSize * inside, Vec2(kOneMinusEpsilon));
}

DirectionalSums DirectionalDistribution::cells(float threshold) const {
  std::vector<QuadtreeNode> nodes(1);
  divide(nodes_, nodes_.data(), 1, threshold, 1, 0, nodes);
  return DirectionalSums(std::move(nodes));
}

DirectionalDistribution DirectionalSums::distribution(float records) const {
  std::vector<QuadtreeNode> sums = nodes_;
  for (size_t i = sums.size(); i-- > 0;)
    for (size_t q = 0; q < 4; ++q)
      if (const uint32_t child = sums[i].child[q]; child != 0) sums[i].values[q] = sums[child].total();
  std::vector<QuadtreeNode> nodes(1);
  add_probabilities(sums, 0, records, 0, nodes);
  return DirectionalDistribution(std::move(nodes));
}

}  // namespace etendue::guiding
