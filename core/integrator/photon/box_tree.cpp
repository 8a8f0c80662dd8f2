#include "integrator/photon/box_tree.h"

#include <algorithm>

namespace etendue::photon {

BoxBlock::BoxBlock() {
  for (auto* values : {&min_x, &min_y, &min_z}) values->fill(kInfinity);
  for (auto* values : {&max_x, &max_y, &max_z}) values->fill(-kInfinity);
}

void BoxBlock::set(size_t i, const Bounds& box) {
  min_x[i] = box.min.x;
  min_y[i] = box.min.y;
  min_z[i] = box.min.z;
  max_x[i] = box.max.x;
  max_y[i] = box.max.y;
  max_z[i] = box.max.z;
}

Bounds BoxBlock::bounds() const {
  const auto least = [](const auto& values) { return *std::ranges::min_element(values); };
  const auto most = [](const auto& values) { return *std::ranges::max_element(values); };
  return {{least(min_x), least(min_y), least(min_z)}, {most(max_x), most(max_y), most(max_z)}};
}

void BoxTree::build(std::span<const Bounds> boxes) {
  blocks_.clear();
  levels_ = 0;
  const auto add_level = [&](size_t count, const auto& box_of) {
    const size_t first = blocks_.size();
    level_[levels_++] = first;
    blocks_.resize(first + (count + BoxBlock::kSize - 1) / BoxBlock::kSize);
    for (size_t i = 0; i < count; ++i) blocks_[first + i / BoxBlock::kSize].set(i % BoxBlock::kSize, box_of(i));
    return first;
  };
  if (boxes.empty()) return;
  size_t below = add_level(boxes.size(), [&](size_t i) { return boxes[i]; });
  while (blocks_.size() - below > 1)
    below = add_level(blocks_.size() - below, [&, below](size_t i) { return blocks_[below + i].bounds(); });
}

}  // namespace etendue::photon
