#include "light/sampling/light_tree_builder.h"

#include <algorithm>

namespace etendue {
namespace {

// The solid angle of the directions of emission, weighted by the cosine beyond the cone of the normals: M_Omega
// [Conty Estevez and Kulla 2018].
float direction_measure(const LightBounds& b) {
  const float o = b.normals;
  const float w = std::min(o + b.emission, kPi);
  return 2 * kPi * (1 - std::cos(o)) +
         kPi / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
}

// The cost of lights in one node. The squared radius replaces the surface area: it is not zero for lights in a row.
float cost_of(const LightBounds& b) { return b.intensity * direction_measure(b) * sqr(b.box.radius()); }

constexpr size_t kBins = 16;

// The bin after which to split, at the least cost of the two parts.
size_t best_split(const std::array<LightBounds, kBins>& bins) {
  std::array<float, kBins> cost_above{};
  LightBounds sum;
  for (size_t i = kBins - 1; i > 0; --i) {
    if (!bins[i].box.empty()) sum.extend(bins[i]);
    cost_above[i - 1] = sum.box.empty() ? kInfinity : cost_of(sum);
  }
  sum = {};
  size_t best = 0;
  float least = kInfinity;
  for (size_t i = 0; i + 1 < kBins; ++i) {
    if (bins[i].box.empty()) continue;
    sum.extend(bins[i]);
    if (const float cost = cost_of(sum) + cost_above[i]; cost < least) {
      least = cost;
      best = i;
    }
  }
  return best;
}

}  // namespace

LightTree::LightTree(std::span<const LightBounds> lights) { Builder(*this, lights).run(); }

LightTree::Builder::Builder(LightTree& tree, std::span<const LightBounds> lights) : tree_(tree), lights_(lights) {
  for (uint32_t i = 0; i < lights.size(); ++i) {
    if (!(lights[i].intensity > 0)) continue;
    order_.push_back(i);
    max_intensity_ = std::max(max_intensity_, lights[i].intensity);
  }
}

void LightTree::Builder::run() {
  tree_.slots_.resize(lights_.size());
  if (order_.empty()) return;
  // Sets in the order in which their nodes are built: no recursion, however deep the tree.
  std::vector<Set> queue{set_of(0, static_cast<uint32_t>(order_.size()))};
  tree_.parents_.emplace_back();
  for (uint32_t node = 0; node < queue.size(); ++node) {
    Node& n = tree_.nodes_.emplace_back();
    const std::vector<Set> children = children_of(queue[node]);
    for (size_t k = 0; k < children.size(); ++k) {
      const Set& child = children[k];
      const Slot slot{node, static_cast<int>(k)};
      if (child.count == 1) {
        const uint32_t light = order_[child.first];
        n.set(slot.child, child.bounds, light | kLeaf);
        tree_.slots_[light] = slot;
      } else {
        n.set(slot.child, child.bounds, static_cast<uint32_t>(queue.size()));
        queue.push_back(child);
        tree_.parents_.push_back(slot);
      }
    }
  }
}

// Intensities are relative to the largest, so that products with squared distances stay in the range of floats.
LightBounds LightTree::Builder::bounds_of(uint32_t light) const {
  LightBounds b = lights_[light];
  b.intensity /= max_intensity_;
  return b;
}

LightTree::Builder::Set LightTree::Builder::set_of(uint32_t first, uint32_t end) const {
  LightBounds bounds;
  for (uint32_t i = first; i < end; ++i) bounds.extend(bounds_of(order_[i]));
  return set_with(first, end, bounds);
}

LightTree::Builder::Set LightTree::Builder::set_with(uint32_t first, uint32_t end, const LightBounds& bounds) {
  return {first, end - first, bounds, end - first > 1 ? cost_of(bounds) : -1};
}

std::vector<LightTree::Builder::Set> LightTree::Builder::children_of(const Set& whole) {
  std::vector<Set> sets;
  sets.reserve(kWidth);
  if (whole.count <= kWidth) {
    for (uint32_t i = whole.first; i < whole.first + whole.count; ++i) sets.push_back(set_of(i, i + 1));
    return sets;
  }
  sets.push_back(whole);
  while (sets.size() < kWidth) {
    const auto worst =
        std::max_element(sets.begin(), sets.end(), [](const Set& a, const Set& b) { return a.cost < b.cost; });
    if (worst->count == 1) break;
    auto [left, right] = split(*worst);
    *worst = std::move(left);
    sets.push_back(std::move(right));
  }
  return sets;
}

// Divides a set of at least two lights at the plane of the least cost, or in the middle if no plane separates them. Reorders
// its lights.
std::pair<LightTree::Builder::Set, LightTree::Builder::Set> LightTree::Builder::split(const Set& set) {
  const auto begin = order_.begin() + set.first;
  const auto end = begin + set.count;
  Bounds centres;
  for (auto i = begin; i != end; ++i) centres.extend(lights_[*i].box.center());
  const Vec3 extent = centres.max - centres.min;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const uint32_t half = set.first + set.count / 2, last = set.first + set.count;
  if (!(extent[axis] > 0)) return {set_of(set.first, half), set_of(half, last)};

  std::array<LightBounds, kBins> bins;
  const auto bin_of = [&](uint32_t light) {
    const float position = (lights_[light].box.center()[axis] - centres.min[axis]) / extent[axis];
    return std::min(static_cast<size_t>(position * kBins), kBins - 1);
  };
  for (auto i = begin; i != end; ++i) bins[bin_of(*i)].extend(bounds_of(*i));
  const size_t best = best_split(bins);
  const auto middle = std::partition(begin, end, [&](uint32_t light) { return bin_of(light) <= best; });
  if (middle == begin || middle == end) return {set_of(set.first, half), set_of(half, last)};
  // The bins hold the bounds of all lights already.
  const auto part = [&](uint32_t from, uint32_t to, size_t first_bin, size_t end_bin) {
    LightBounds bounds;
    for (size_t i = first_bin; i < end_bin; ++i)
      if (!bins[i].box.empty()) bounds.extend(bins[i]);
    return set_with(from, to, bounds);
  };
  const auto number = static_cast<uint32_t>(middle - order_.begin());
  return {part(set.first, number, 0, best + 1), part(number, last, best + 1, kBins)};
}

}  // namespace etendue
