// A hierarchy over lights, to choose one by what it may bring to a place.
//                              Conty Estevez and Kulla, Importance Sampling of Many Lights with Adaptive Tree
//                              Splitting, 2018; bounds on directions as in Pharr, Jakob, Humphreys, pbrt, 4th ed., 12.6
//
// A node bounds where its lights are (a sphere), which way they face and how far from there they still send light (two
// angles about an axis), and sums the intensities they send at most. What it may bring to a place at distance d is
//
//   intensity cos(theta') / max(d, radius)^2,    theta' = the least angle at which any of its lights may send there
//
// and 0 where none of them can. The way down from the root takes one of kWidth children at a time, in proportion to
// that. Only the receiver's place counts, not its normal, so that a walk that ran into a light knows enough to ask for
// the probability with which the light would have been chosen.
#pragma once
#include <span>
#include <vector>

#include "base/piecewise_constant.h"
#include "geometry/mesh.h"

namespace etendue {

// Of one light or of several.
struct LightBounds {
  Bounds box;
  Vec3 axis{0, 0, 1};
  float normals = kPi;       // the axis is no farther than this from any light's normal, radians
  float emission = kPi / 2;  // and nothing is sent farther than this from a normal
  bool two_sided = false;    // all the same about the opposite axis
  float intensity = 0;       // W/sr at most, the sum
  float range = kInfinity;   // metres beyond which nothing arrives

  void extend(const LightBounds& other);
};

class LightTree {
 public:
  LightTree() = default;
  // Light i of `lights`; one without intensity is never chosen.
  explicit LightTree(std::span<const LightBounds> lights);

  bool empty() const { return nodes_.empty(); }
  size_t memory() const { return nodes_.size() * sizeof(Node) + (parents_.size() + places_.size()) * sizeof(Place); }

  // A light with its probability, which is 0 if none was found to reach that place.
  AliasTable::Choice choose(const Vec3& from, float u) const;
  // With which `choose` takes that light from there.
  float probability(uint32_t light, const Vec3& from) const;

 private:
  static constexpr int kWidth = 8;
  static constexpr uint32_t kLeaf = 0x80000000U, kNone = 0xffffffffU;
  using Lanes = std::array<float, kWidth>;
  class Builder;

  // Of its children, number by number.
  struct alignas(64) Node {
    Lanes x{}, y{}, z{}, radius{}, over_radius2{}, over_reach2{};
    Lanes axis_x{}, axis_y{}, axis_z{};
    Lanes other_side{};  // what the cosine to the axis is times for the side that counts as well: -1, or 1 for none
    Lanes cos_normals{}, sin_normals{}, cos_emission{}, intensity{};
    std::array<uint32_t, kWidth> child{};  // a node, or a light and kLeaf

    void set(int slot, const LightBounds& bounds, uint32_t what);
    // Of each child and of those before it.
    void importance(const Vec3& from, Lanes& sums) const;
  };
  // The node and the child of it that something is.
  struct Place {
    uint32_t node = kNone;
    int slot = 0;
  };

  std::vector<Node> nodes_;     // the root first
  std::vector<Place> parents_;  // of nodes
  std::vector<Place> places_;   // of lights
};

}  // namespace etendue
