#include "light/light_tree.h"

#include <algorithm>
#include <numeric>

#include "base/vectorize.h"

namespace etendue {
namespace {

Vec3 some_perpendicular(const Vec3& v) {
  return glm::normalize(std::abs(v.x) > 0.5f ? Vec3(-v.y, v.x, 0) : Vec3(0, -v.z, v.y));
}

// The least cone about both.
void unite_cones(Vec3& axis, float& angle, Vec3 other_axis, float other_angle) {
  if (angle < other_angle) std::swap(axis, other_axis), std::swap(angle, other_angle);
  if (angle >= kPi) return;
  const float cosine = std::clamp(glm::dot(axis, other_axis), -1.0f, 1.0f);
  // Half the chord: what the arc cosine makes of directions that are almost the same is far off.
  const float between = cosine > 0.9f ? 2 * std::asin(0.5f * glm::distance(axis, other_axis)) : std::acos(cosine);
  if (between + other_angle <= angle) return;
  const float united = 0.5f * (angle + between + other_angle);
  const float turn = united - angle;
  if (united >= kPi) return static_cast<void>(angle = kPi);
  const Vec3 across = normalize_or(other_axis - cosine * axis, some_perpendicular(axis));
  axis = glm::normalize(std::cos(turn) * axis + std::sin(turn) * across);
  angle = united;
}

// How much the directions of emission spread, as Conty Estevez and Kulla measure it.
float spread(const LightBounds& b) {
  const float o = b.normals, w = std::min(o + b.emission, kPi);
  return 2 * kPi * (1 - std::cos(o)) +
         kPi / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
}

// What it costs to have these lights in one node: how different they are to those who choose among them. The square of
// the radius, unlike a surface, is not zero where lights stand in a row.
float cost(const LightBounds& b) { return b.intensity * spread(b) * sqr(b.box.radius()); }

// Squares smaller than this are taken for this: a light at the very place.
constexpr float kLeastSquare = 1e-30f;

}  // namespace

void LightBounds::extend(const LightBounds& other) {
  if (box.empty()) {
    *this = other;
    return;
  }
  two_sided = two_sided || other.two_sided;
  unite_cones(axis, normals, two_sided && glm::dot(axis, other.axis) < 0 ? -other.axis : other.axis, other.normals);
  emission = std::max(emission, other.emission);
  box.extend(other.box);
  intensity += other.intensity;
  range = std::max(range, other.range);
}

void LightTree::Node::set(int slot, const LightBounds& b, uint32_t what) {
  const auto i = static_cast<size_t>(slot);
  const Vec3 centre = b.box.center();
  // Roundings of coordinates must not move a light out of its sphere.
  const float ball = b.box.radius() * (1 + 1e-5f) + 1e-6f * max_component(glm::abs(centre));
  x[i] = centre.x, y[i] = centre.y, z[i] = centre.z, radius[i] = ball;
  over_radius2[i] = 1 / std::max(sqr(ball), kLeastSquare), over_reach2[i] = 1 / sqr(b.range + ball);
  axis_x[i] = b.axis.x, axis_y[i] = b.axis.y, axis_z[i] = b.axis.z, other_side[i] = b.two_sided ? -1 : 1;
  cos_normals[i] = std::cos(b.normals), sin_normals[i] = std::max(std::sin(b.normals), 0.0f);
  cos_emission[i] = std::cos(b.emission) - 1e-5f;
  intensity[i] = b.intensity, child[i] = what;
}

// Sines and cosines of angles between 0 and pi, from which others are taken off until nothing is left: no branches, so
// that all children are done at once. A step of a loop takes longest over quotients and roots.
ETENDUE_VECTORIZE void LightTree::Node::importance(const Vec3& from, Lanes& sums) const {
  alignas(32) Lanes of;
#pragma GCC ivdep
  for (size_t i = 0; i < kWidth; ++i) {
    const Vec3 v(from.x - x[i], from.y - y[i], from.z - z[i]);
    const float over2 = 1 / std::max(length_squared(v), kLeastSquare), over = std::sqrt(over2);
    const float along = (v.x * axis_x[i] + v.y * axis_y[i] + v.z * axis_z[i]) * over;
    const float cos_axis = std::min(std::max(along, along * other_side[i]), 1.0f);
    const float sin_axis = std::sqrt(std::max(0.0f, 1 - cos_axis * cos_axis));
    // From the nearest normal.
    const bool among = cos_axis > cos_normals[i];
    const float cos_normal = select(among, 1.0f, cos_axis * cos_normals[i] + sin_axis * sin_normals[i]);
    const float sin_normal = select(among, 0.0f, sin_axis * cos_normals[i] - cos_axis * sin_normals[i]);
    // From the nearest point.
    const float sin_ball = std::min(radius[i] * over, 1.0f);
    const float cos_ball = std::sqrt(1 - sin_ball * sin_ball);
    const bool facing = cos_normal > cos_ball || sin_ball == 1;
    const float cosine = select(facing, 1.0f, cos_normal * cos_ball + sin_normal * sin_ball);
    const bool reached = cosine > cos_emission[i] && over2 >= over_reach2[i];
    const float most = intensity[i] * std::max(cosine, 1e-5f) * std::min(over2, over_radius2[i]);
    of[i] = select(reached, most, 0.0f);
  }
  float sum = 0;
  for (size_t i = 0; i < kWidth; ++i) sums[i] = sum += of[i];
}

AliasTable::Choice LightTree::choose(const Vec3& from, float u) const {
  float probability = 1;
  for (uint32_t node = 0;;) {
    Lanes sums;
    nodes_[node].importance(from, sums);
    const float all = sums.back();
    if (!(all > 0)) return {0, 0};
    const float at = u * all;
    // The first whose sum is beyond it, by halves and without branches, which would be anybody's guess. Rounding may
    // have left something over: it belongs to the last that counts.
    static_assert(kWidth == 8);
    size_t slot = sums[3] <= at ? 4 : 0;
    slot += sums[slot + 1] <= at ? 2 : 0;
    slot += sums[slot] <= at ? 1 : 0;
    if (at >= all) slot = static_cast<size_t>(std::find(sums.begin(), sums.end(), all) - sums.begin());
    const float before = slot > 0 ? sums[slot - 1] : 0, own = sums[slot] - before;
    probability *= own / all;
    u = std::min((at - before) / own, kOneMinusEpsilon);
    node = nodes_[node].child[slot];
    if (node & kLeaf) return {node & ~kLeaf, probability};
  }
}

float LightTree::probability(uint32_t light, const Vec3& from) const {
  float probability = 1;
  for (Place at = places_[light]; at.node != kNone; at = parents_[at.node]) {
    Lanes sums;
    nodes_[at.node].importance(from, sums);
    const auto slot = static_cast<size_t>(at.slot);
    const float own = sums[slot] - (slot > 0 ? sums[slot - 1] : 0);
    if (!(own > 0)) return 0;
    probability *= own / sums.back();
  }
  return places_[light].node == kNone ? 0 : probability;
}

// From the root on a node takes all of its lights, and the worst of what it has is cut in two until it has kWidth.
class LightTree::Builder {
 public:
  Builder(LightTree& tree, std::span<const LightBounds> lights) : tree_(tree), lights_(lights) {
    for (uint32_t i = 0; i < lights.size(); ++i)
      if (lights[i].intensity > 0) order_.push_back(i), whole_ = std::max(whole_, lights[i].intensity);
  }

  void run() {
    tree_.places_.resize(lights_.size());
    if (order_.empty()) return;
    // Nodes wait in the order in which they are built: no recursion, however deep the tree.
    std::vector<Set> waiting{set_of(0, static_cast<uint32_t>(order_.size()))};
    tree_.parents_.emplace_back();
    for (uint32_t node = 0; node < waiting.size(); ++node) {
      Node& n = tree_.nodes_.emplace_back();
      const std::vector<Set> children = cut(waiting[node]);
      for (size_t k = 0; k < children.size(); ++k) {
        const Set& child = children[k];
        const Place place{node, static_cast<int>(k)};
        if (child.count == 1) {
          const uint32_t light = order_[child.first];
          n.set(place.slot, child.bounds, light | kLeaf);
          tree_.places_[light] = place;
        } else {
          n.set(place.slot, child.bounds, static_cast<uint32_t>(waiting.size()));
          waiting.push_back(child), tree_.parents_.push_back(place);
        }
      }
    }
  }

 private:
  // Neighbours in `order_`.
  struct Set {
    uint32_t first = 0, count = 0;
    LightBounds bounds;
    float cost = 0;
  };

  // Relative to the strongest, so that squares of distances cannot carry it out of what floats hold.
  LightBounds bounds_of(uint32_t light) const {
    LightBounds b = lights_[light];
    b.intensity /= whole_;
    return b;
  }

  Set set_of(uint32_t first, uint32_t end) const {
    Set set{first, end - first, {}, 0};
    for (uint32_t i = first; i < end; ++i) set.bounds.extend(bounds_of(order_[i]));
    set.cost = set.count > 1 ? etendue::cost(set.bounds) : -1;
    return set;
  }

  std::vector<Set> cut(const Set& whole) {
    std::vector<Set> sets{whole};
    while (sets.size() < kWidth) {
      const auto worst =
          std::max_element(sets.begin(), sets.end(), [](const Set& a, const Set& b) { return a.cost < b.cost; });
      if (worst->count == 1) break;
      const Set set = *worst;
      const uint32_t middle = divide(set), end = set.first + set.count;
      *worst = set_of(set.first, middle);
      sets.push_back(set_of(middle, end));
    }
    return sets;
  }

  // Orders the set's lights so that the two parts with the least cost lie on either side of what is returned; parts of
  // the same number where no plane divides them.
  uint32_t divide(const Set& set) {
    const auto begin = order_.begin() + set.first, end = begin + set.count;
    Bounds centres;
    for (auto i = begin; i != end; ++i) centres.extend(lights_[*i].box.center());
    const Vec3 extent = centres.max - centres.min;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const uint32_t half = set.first + set.count / 2;
    if (!(extent[axis] > 0)) return half;

    std::array<LightBounds, kBins> bins;
    const auto bin_of = [&](uint32_t light) {
      const float part = (lights_[light].box.center()[axis] - centres.min[axis]) / extent[axis];
      return std::min(static_cast<size_t>(part * kBins), kBins - 1);
    };
    for (auto i = begin; i != end; ++i) bins[bin_of(*i)].extend(bounds_of(*i));
    const size_t best = best_plane(bins);
    const auto middle = std::partition(begin, end, [&](uint32_t light) { return bin_of(light) <= best; });
    return middle == begin || middle == end ? half : static_cast<uint32_t>(middle - order_.begin());
  }

  static constexpr size_t kBins = 16;
  // The bin after which to divide.
  static size_t best_plane(const std::array<LightBounds, kBins>& bins) {
    std::array<float, kBins> above{};
    LightBounds sum;
    for (size_t i = kBins - 1; i > 0; --i) {
      if (!bins[i].box.empty()) sum.extend(bins[i]);
      above[i - 1] = sum.box.empty() ? kInfinity : etendue::cost(sum);
    }
    sum = {};
    size_t best = 0;
    float least = kInfinity;
    for (size_t i = 0; i + 1 < kBins; ++i) {
      if (bins[i].box.empty()) continue;
      sum.extend(bins[i]);
      if (const float both = etendue::cost(sum) + above[i]; both < least) least = both, best = i;
    }
    return best;
  }

  LightTree& tree_;
  std::span<const LightBounds> lights_;
  std::vector<uint32_t> order_;
  float whole_ = 0;
};

LightTree::LightTree(std::span<const LightBounds> lights) { Builder(*this, lights).run(); }

}  // namespace etendue
