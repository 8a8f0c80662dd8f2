#include "integrator/guiding/radiance_guide.h"

#include <algorithm>
#include <cmath>

namespace etendue::guiding {
namespace {

// Cells of directions that hold a larger fraction of the radiance are divided [Müller et al. 2017].
constexpr float kCellThreshold = 0.01f;
// The largest change of the fraction in one iteration.
constexpr double kLargestStep = 0.3;
constexpr double kFewRecords = 32;
// Regions with fewer effective records are not divided.
constexpr double kRecordsToDivide = 64;

// Reads a quadtree.
template <class Tree>
bool read_tree(StateReader& in, Tree& tree) {
  std::vector<QuadtreeNode> nodes;
  if (!in.list(nodes) || !is_quadtree(nodes)) return false;
  tree = Tree(std::move(nodes));
  return true;
}

}  // namespace

RadianceGuide::RadianceGuide(const Vec3& corner, const Vec3& size, bool learns_fraction, float fraction)
    : learns_fraction_(learns_fraction), nodes_(1), regions_(1) {
  regions_[0].corner = corner;
  regions_[0].size = size;
  regions_[0].fraction = fraction;
}

void RadianceGuide::end_iteration(uint64_t most_records) {
  for (Region& region : regions_) update(region);
  for (uint32_t i = 0; i < nodes_.size(); ++i)
    if (nodes_[i].axis < 0) divide(i, most_records);
  for (Region& region : regions_) {
    region.slope = region.curvature = region.radiance = region.squares = 0;
    region.records = 0;
  }
}

// A region without light keeps its guide.
void RadianceGuide::update(Region& region) const {
  if (learns_fraction_ && region.is_ready()) update_fraction(region);
  if (region.radiance > 0) {
    region.guide = region.sums.distribution(static_cast<float>(region.effective_records()));
    region.flux = static_cast<float>(region.radiance / static_cast<double>(region.records));
  }
  region.sums = region.guide.cells(kCellThreshold);
}

// Few records make a short step, because their sums are noisy.
void RadianceGuide::update_fraction(Region& region) const {
  if (!(region.curvature > 0)) return;
  const double records = region.effective_records(), trust = records / (records + kFewRecords);
  const double step = trust * std::clamp(region.slope / region.curvature, -kLargestStep, kLargestStep);
  region.fraction = std::clamp(region.fraction + static_cast<float>(step), kMinFraction, kMaxFraction);
}

// Halves the box of a leaf across its longest side. New leaves are appended and examined in turn.
void RadianceGuide::divide(uint32_t node, uint64_t most_records) {
  const uint32_t index = nodes_[node].child[0];
  if (regions_[index].records <= most_records || regions_.size() >= kMaxRegions) return;
  if (regions_[index].effective_records() < kRecordsToDivide) return;
  Region& lower = regions_[index];
  const Vec3 size = lower.size;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  lower.size[axis] *= 0.5f;
  lower.records /= 2;
  lower.radiance /= 2;
  lower.squares /= 2;
  Region upper = lower;
  upper.corner[axis] += lower.size[axis];
  const float middle = upper.corner[axis];
  const auto first = static_cast<uint32_t>(nodes_.size());
  nodes_.push_back({.child = {index, 0}});
  nodes_.push_back({.child = {static_cast<uint32_t>(regions_.size()), 0}});
  nodes_[node] = {axis, middle, {first, first + 1}};
  regions_.push_back(std::move(upper));
}

size_t RadianceGuide::memory() const {
  size_t bytes = nodes_.size() * sizeof(Node) + regions_.size() * sizeof(Region);
  for (const Region& region : regions_)
    bytes += (region.guide.nodes().size() + region.sums.nodes().size()) * sizeof(QuadtreeNode);
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
    out.value(region.radiance);
    out.value(region.squares);
    out.value(region.records);
    out.value(region.flux);
    out.value(region.corner);
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
        !in.value(region.slope) || !in.value(region.curvature) || !in.value(region.radiance) ||
        !in.value(region.squares) || !in.value(region.records) || !in.value(region.flux) || !in.value(region.corner) ||
        !in.value(region.size))
      return false;
  return true;
}

}  // namespace etendue::guiding
