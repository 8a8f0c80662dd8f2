#include "light/sampling/light_tree.h"

#include <algorithm>

#include "base/vectorize.h"

namespace etendue {
namespace {

// Smaller squared distances and radii are replaced by this one: a receiver may be exactly at a light.
constexpr float kMinSquare = 1e-30f;
// The smallest factor for a receiver that faces away. Its shading may still reflect light, because shading normals differ
// from geometric ones.
constexpr float kLeastCosine = 0.02f;

}  // namespace

void LightTree::Node::set(int slot, const LightBounds& b, uint32_t child_number) {
  const auto i = static_cast<size_t>(slot);
  const Vec3 centre = b.box.center();
  // Larger than the box, so that rounding cannot move a light out of its sphere.
  const float sphere = b.box.radius() * (1 + 1e-5f) + 1e-6f * max_component(glm::abs(centre));
  x[i] = centre.x;
  y[i] = centre.y;
  z[i] = centre.z;
  radius[i] = sphere;
  inverse_radius2[i] = 1 / std::max(sqr(sphere), kMinSquare);
  inverse_reach2[i] = 1 / sqr(b.range + sphere);
  axis_x[i] = b.axis.x;
  axis_y[i] = b.axis.y;
  axis_z[i] = b.axis.z;
  opposite_side[i] = b.two_sided ? -1 : 1;
  cos_normals[i] = std::cos(b.normals);
  sin_normals[i] = std::max(std::sin(b.normals), 0.0f);
  cos_emission[i] = std::cos(b.emission) - 1e-5f;
  intensity[i] = b.intensity;
  child[i] = child_number;
}

// theta' = max(0, angle to the axis - angle of the normals - angle of the bounding sphere), with sines and cosines of
// the angles. No branches: all children are computed at once. Quotients and square roots dominate the cost.
ETENDUE_VECTORIZE void LightTree::Node::importance(const Vec3& from, const Vec3& normal, Lanes& sums) const {
  alignas(32) Lanes values;
  // Without a normal the factor is 1.
  const float least = normal == Vec3(0) ? 1.0f : kLeastCosine;
#pragma GCC ivdep
  for (size_t i = 0; i < kWidth; ++i) {
    const Vec3 v(from.x - x[i], from.y - y[i], from.z - z[i]);
    const float inverse2 = 1 / std::max(length_squared(v), kMinSquare);
    const float inverse = std::sqrt(inverse2);
    const float along = (v.x * axis_x[i] + v.y * axis_y[i] + v.z * axis_z[i]) * inverse;
    const float cos_axis = std::min(std::max(along, along * opposite_side[i]), 1.0f);
    const float sin_axis = std::sqrt(std::max(0.0f, 1 - cos_axis * cos_axis));
    // The angle to the nearest normal.
    const bool within = cos_axis > cos_normals[i];
    const float cos_normal = select(within, 1.0f, cos_axis * cos_normals[i] + sin_axis * sin_normals[i]);
    const float sin_normal = select(within, 0.0f, sin_axis * cos_normals[i] - cos_axis * sin_normals[i]);
    // The angle of the bounding sphere.
    const float sin_sphere = std::min(radius[i] * inverse, 1.0f);
    const float cos_sphere = std::sqrt(1 - sin_sphere * sin_sphere);
    const bool facing = cos_normal > cos_sphere || sin_sphere == 1;
    const float cosine = select(facing, 1.0f, cos_normal * cos_sphere + sin_normal * sin_sphere);
    // The cosine between the normal of the receiver and the nearest direction to the sphere.
    const float cos_receiver = -(v.x * normal.x + v.y * normal.y + v.z * normal.z) * inverse;
    const float sin_receiver = std::sqrt(std::max(0.0f, 1 - cos_receiver * cos_receiver));
    const float below = cos_receiver * cos_sphere + sin_receiver * sin_sphere;
    const float received = std::min(std::max(select(cos_receiver > cos_sphere, 1.0f, below), least), 1.0f);
    const bool reached = cosine > cos_emission[i] && inverse2 >= inverse_reach2[i];
    const float bound = intensity[i] * std::max(cosine, 1e-5f) * received * std::min(inverse2, inverse_radius2[i]);
    values[i] = select(reached, bound, 0.0f);
  }
  float sum = 0;
  for (size_t i = 0; i < kWidth; ++i) sums[i] = sum += values[i];
}

AliasTable::Choice LightTree::choose(const LightReceiver& from, float u) const {
  const Vec3 normal = from.normal.unpacked();
  float probability = 1;
  for (uint32_t node = 0;;) {
    Lanes sums;
    nodes_[node].importance(from.position, normal, sums);
    const float all = sums.back();
    if (!(all > 0)) return {0, 0};
    const float target = u * all;
    // The first child whose prefix sum exceeds the target, by bisection without branches, which would be unpredictable.
    // Rounding may leave the target at the end: the last child with a contribution is chosen then.
    static_assert(kWidth == 8);
    size_t slot = sums[3] <= target ? 4 : 0;
    slot += sums[slot + 1] <= target ? 2 : 0;
    slot += sums[slot] <= target ? 1 : 0;
    if (target >= all) slot = static_cast<size_t>(std::find(sums.begin(), sums.end(), all) - sums.begin());
    const float before = slot > 0 ? sums[slot - 1] : 0;
    const float importance = sums[slot] - before;
    probability *= importance / all;
    u = std::min((target - before) / importance, kOneMinusEpsilon);
    node = nodes_[node].child[slot];
    if (node & kLeaf) return {node & ~kLeaf, probability};
  }
}

float LightTree::probability(uint32_t light, const LightReceiver& from) const {
  const Vec3 normal = from.normal.unpacked();
  float probability = 1;
  for (Slot at = slots_[light]; at.node != kNone; at = parents_[at.node]) {
    Lanes sums;
    nodes_[at.node].importance(from.position, normal, sums);
    const auto slot = static_cast<size_t>(at.child);
    const float importance = sums[slot] - (slot > 0 ? sums[slot - 1] : 0);
    if (!(importance > 0)) return 0;
    probability *= importance / sums.back();
  }
  return slots_[light].node == kNone ? 0 : probability;
}

}  // namespace etendue
