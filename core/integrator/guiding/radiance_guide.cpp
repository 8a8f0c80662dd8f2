#include "integrator/guiding/radiance_guide.h"

#include <algorithm>
#include <cmath>

namespace etendue::guiding {
namespace {

// Cells of directions that hold a larger fraction of the radiance are divided [Müller et al. 2017, sec. 3.2].
constexpr float kCellThreshold = 0.01f;
// The largest change of the fraction in one iteration.
constexpr double kLargestStep = 0.3;
constexpr double kFewRecords = 500;

bool read_tree(StateReader& in, DirectionalTree& tree) {
  std::vector<DirectionalTree::Node> nodes;
  return in.list(nodes) && tree.assign(std::move(nodes));
}

}  // namespace

RadianceGuide::RadianceGuide(const Bounds& bounds, bool learns_fraction, float fraction)
    : corner_(0), size_(1), learns_fraction_(learns_fraction), nodes_(1), regions_(1) {
  if (!bounds.empty()) {
    corner_ = bounds.min;
    size_ = bounds.max - bounds.min;
  }
  nodes_[0].child[0] = 0;
  regions_[0].size = size_;
  regions_[0].fraction = fraction;
}

uint32_t RadianceGuide::region_at(const Vec3& position) const {
  Vec3 corner = corner_, size = size_;
  const Node* node = nodes_.data();
  while (node->axis >= 0) {
    size[node->axis] *= 0.5f;
    const float middle = corner[node->axis] + size[node->axis];
    const bool upper = position[node->axis] >= middle;
    if (upper) corner[node->axis] = middle;
    node = &nodes_[node->child[upper ? 1 : 0]];
  }
  return node->child[0];
}

void RadianceGuide::end_iteration(uint64_t most_records) {
  for (Region& region : regions_) {
    region.sums.sum_up();
    if (learns_fraction_ && region.is_ready()) update_fraction(region);
    // A region without light keeps its guide.
    if (region.sums.total() > 0) std::swap(region.guide, region.sums);
    region.sums = region.guide.refined(kCellThreshold);
    region.slope = region.curvature = 0;
  }
  for (uint32_t i = 0; i < nodes_.size(); ++i)
    if (nodes_[i].axis < 0) divide(i, most_records);
  for (Region& region : regions_) region.records = 0;
}

// Few records make a short step, because their sums are noisy.
void RadianceGuide::update_fraction(Region& region) const {
  if (!(region.curvature > 0)) return;
  const double trust = static_cast<double>(region.records) / (static_cast<double>(region.records) + kFewRecords);
  const double step = trust * std::clamp(region.slope / region.curvature, -kLargestStep, kLargestStep);
  region.fraction = std::clamp(region.fraction + static_cast<float>(step), kMinFraction, kMaxFraction);
}

// Halves the box of a leaf across its longest side. New leaves are appended and examined in turn.
void RadianceGuide::divide(uint32_t node, uint64_t most_records) {
  const uint32_t index = nodes_[node].child[0];
  if (regions_[index].records <= most_records || regions_.size() >= kMaxRegions) return;
  Region& region = regions_[index];
  const Vec3 size = region.size;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  region.size[axis] *= 0.5f;
  region.records /= 2;
  const auto other = static_cast<uint32_t>(regions_.size());
  regions_.push_back(Region(region));
  const auto lower = static_cast<uint32_t>(nodes_.size());
  nodes_.push_back({-1, {index, 0}});
  nodes_.push_back({-1, {other, 0}});
  nodes_[node] = {axis, {lower, lower + 1}};
}

size_t RadianceGuide::memory() const {
  size_t bytes = nodes_.size() * sizeof(Node) + regions_.size() * sizeof(Region);
  for (const Region& region : regions_)
    bytes += (region.guide.nodes().size() + region.sums.nodes().size()) * sizeof(DirectionalTree::Node);
  return bytes;
}

void RadianceGuide::write(StateWriter& out) const {
  out.list(std::span<const Node>(nodes_));
  out.value<uint64_t>(regions_.size());
  for (const Region& region : regions_) {
    out.list(std::span(region.guide.nodes()));
    out.list(std::span(region.sums.nodes()));
    out.value(region.fraction);
    out.value(region.slope);
    out.value(region.curvature);
    out.value(region.records);
    out.value(region.size);
  }
}

bool RadianceGuide::read(StateReader& in) {
  uint64_t count = 0;
  if (!in.list(nodes_) || !in.value(count) || nodes_.empty() || count == 0 || count > kMaxRegions) return false;
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (node.axis < 0 ? node.child[0] >= count
                      : node.axis > 2 || node.child[0] <= i || node.child[1] <= i || node.child[0] >= nodes_.size() ||
                            node.child[1] >= nodes_.size())
      return false;
  }
  regions_.assign(count, Region());
  for (Region& region : regions_)
    if (!read_tree(in, region.guide) || !read_tree(in, region.sums) || !in.value(region.fraction) ||
        !in.value(region.slope) || !in.value(region.curvature) || !in.value(region.records) || !in.value(region.size))
      return false;
  return true;
}

}  // namespace etendue::guiding
