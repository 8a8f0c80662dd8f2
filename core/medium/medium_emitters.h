// Sampling of points in media that emit light, where light paths start, and of directions towards these media.
//
// A point is sampled in a cell of an emitting medium, which is chosen by its emitted power. It gives a direction. The
// estimate then integrates the emission along the whole ray [Simon et al. 2017]. The density of points p is constant in
// each cell, so the density of a direction w at a receiver x is known in closed form:
//
//   p(w) = int p(x + t w) t^2 dt    per solid angle, over the whole ray
//
// It depends on the receiver and the direction only. Occlusion, attenuation and the surfaces on the ray do not matter,
// so the density serves as the MIS density of a direction that another technique sampled.
#pragma once
#include <span>

#include "base/piecewise_constant.h"
#include "medium/heterogeneous_medium.h"

namespace etendue {

// A box that contains an emitting medium, divided into cells.
struct EmitterBox {
  Mat4 world_to_box{1};  // to the unit cube
  GridSize cells{1, 1, 1};
  Vec3 cells_per_unit{1};    // not an integer if the last cell of an axis is smaller
  std::vector<float> power;  // of the cells, in proportion to their emitted power; x varies fastest
};

// The box of a heterogeneous medium, with the coarse cells of its grid.
EmitterBox emitter_box(const HeterogeneousMedium& medium);
// The axis-aligned box between two corners, filled with a homogeneous medium: one cell.
EmitterBox emitter_box(const HomogeneousMedium& medium, const Vec3& lowest, const Vec3& highest);

class MediumEmitters {
 public:
  MediumEmitters() = default;
  // Boxes without power or volume are left out.
  explicit MediumEmitters(std::span<const EmitterBox> boxes);

  bool empty() const { return boxes_.empty(); }
  // The emitted power as the mean over the colour channels, W. Bounding boxes count as filled.
  float power() const { return power_; }

  struct Point {
    Vec3 position{0};
    float pdf = 0;  // 1/m^3, of all boxes that contain the point
  };
  // `choice` selects a cell, `position` a point in it; all numbers are uniform in [0, 1).
  Point sample_point(float choice, const Vec3& position) const;

  struct Sample {
    Vec3 direction{0, 0, 1};
    float pdf = 0;  // per solid angle; 0 if there is no direction
  };
  // The direction to a point that is sampled from the same numbers.
  Sample sample(const Vec3& from, float choice, const Vec3& position) const;
  // The density of a unit direction.
  float pdf(const Vec3& from, const Vec3& direction) const;

 private:
  struct Box {
    Mat4 world_to_box, box_to_world;
    GridSize cells;
    Vec3 cells_per_unit;
    std::vector<float> density;  // of sampled points per cell, 1/m^3
    uint32_t first_cell;         // its number among the cells of all boxes
  };

  Vec3 point_in_cell(float choice, const Vec3& position) const;

  std::vector<Box> boxes_;
  AliasTable cells_;  // of all boxes
  float power_ = 0;
};

}  // namespace etendue
