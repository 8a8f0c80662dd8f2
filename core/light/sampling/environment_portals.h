// Rectangles through which the environment lights a room.
//
// A portal guides the sampling of the environment and changes nothing else. At a receiver that sees the front of at
// least one portal, half of the directions lead to points uniform over the portals that it sees; the others follow the
// environment map. The density is that of the mixture, so that light through other openings is found as well: a portal
// never changes the expected image.                                              (compare [Bitterli et al. 2015])
#pragma once
#include <vector>

#include "base/vec.h"

namespace etendue {

// A rectangle in world space that faces its normal.
struct EnvironmentPortal {
  Vec3 centre{0};
  Vec3 half_x{0}, half_y{0};  // m
  Vec3 normal{0};             // unit; the receivers that it guides are on this side

  friend bool operator==(const EnvironmentPortal&, const EnvironmentPortal&) = default;
};

class EnvironmentPortals {
 public:
  EnvironmentPortals() = default;
  // Portals without area are ignored.
  explicit EnvironmentPortals(std::vector<EnvironmentPortal> portals);

  bool empty() const { return portals_.empty(); }
  const std::vector<EnvironmentPortal>& all() const { return portals_; }

  // The share of directions through portals at a receiver: 0 if it faces none.
  float probability(const Vec3& from) const { return facing(from) > 0 ? 0.5f : 0; }
  // A unit direction through a portal that the receiver faces. There has to be one.
  Vec3 sample(const Vec3& from, Vec2 u) const;
  // Its density per solid angle.
  float pdf(const Vec3& from, const Vec3& direction) const;

 private:
  int facing(const Vec3& from) const;

  std::vector<EnvironmentPortal> portals_;
};

}  // namespace etendue
