// A tree over lights that chooses one in proportion to a bound of its contribution at a receiver.
//                                    [Conty Estevez and Kulla 2018; bounds on directions: Pharr et al. 2023,
//                                    sec. 12.6.3]
//
// A node bounds the positions of its lights (a sphere of radius R), their normals and the directions in which they emit
// (two angles about an axis), and the sum of their largest intensities I. Its importance at a receiver at distance d is
//
//   I cos(theta') c / max(d, R)^2,    theta' = the smallest angle between a normal and the direction to the receiver
//
// and 0 if none of its lights can emit towards the receiver. c bounds the cosine between the normal of the receiver and the
// directions to the sphere, from below by kLeastCosine, so that every light which can emit towards the receiver may be
// chosen; it is 1 for a receiver without a normal. The descent from the root chooses one of kWidth children at a time in
// proportion to importance.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "base/piecewise_constant.h"
#include "light/sampling/light_bounds.h"
#include "light/sampling/light_receiver.h"

namespace etendue {

class LightTree {
 public:
  LightTree() = default;
  // Light i is lights[i]; a light of intensity 0 is never chosen.
  explicit LightTree(std::span<const LightBounds> lights);

  bool empty() const { return nodes_.empty(); }

  // A light with its probability; the probability is 0 if no light can reach the receiver.
  AliasTable::Choice choose(const LightReceiver& from, float u) const;
  // The probability with which `choose` returns a light.
  float probability(uint32_t light, const LightReceiver& from) const;

 private:
  static constexpr int kWidth = 8;
  static constexpr uint32_t kLeaf = 0x80000000U;
  static constexpr uint32_t kNone = 0xffffffffU;
  using Lanes = std::array<float, kWidth>;
  class Builder;

  // The bounds of kWidth children, one array per quantity.
  struct alignas(64) Node {
    Lanes x{}, y{}, z{};  // centre of the bounding sphere
    Lanes radius{};
    Lanes inverse_radius2{};
    Lanes inverse_reach2{};  // squared distance from the centre beyond which the range ends
    Lanes axis_x{}, axis_y{}, axis_z{};
    Lanes opposite_side{};  // -1 if the lights are two-sided, else 1: a factor on the cosine to the axis
    Lanes cos_normals{}, sin_normals{}, cos_emission{}, intensity{};
    std::array<uint32_t, kWidth> child{};  // a node, or a light with kLeaf

    void set(int slot, const LightBounds& bounds, uint32_t child_number);
    // Prefix sums of the importance of the children.
    void importance(const Vec3& from, const Vec3& normal, Lanes& sums) const;
  };
  // A child of a node.
  struct Slot {
    uint32_t node = kNone;
    int child = 0;
  };

  std::vector<Node> nodes_;    // the root first
  std::vector<Slot> parents_;  // of nodes
  std::vector<Slot> slots_;    // of lights
};

}  // namespace etendue
