// Building the tree over lights, from the root down.                                  [Conty Estevez and Kulla 2018]
#pragma once
#include <utility>

#include "light/sampling/light_tree.h"

namespace etendue {

// A node starts with all its lights as one set. The set of the largest cost is split in two until there are kWidth
// sets.
class LightTree::Builder {
 public:
  Builder(LightTree& tree, std::span<const LightBounds> lights);

  void run();

 private:
  // Neighbours in `order_`.
  struct Set {
    uint32_t first = 0, count = 0;
    LightBounds bounds;
    float cost = 0;
  };

  LightBounds bounds_of(uint32_t light) const;
  Set set_of(uint32_t first, uint32_t end) const;
  static Set set_with(uint32_t first, uint32_t end, const LightBounds& bounds);
  std::vector<Set> children_of(const Set& whole);
  std::pair<Set, Set> split(const Set& set);

  LightTree& tree_;
  std::span<const LightBounds> lights_;
  std::vector<uint32_t> order_;  // lights with an intensity
  float max_intensity_ = 0;
};

}  // namespace etendue
