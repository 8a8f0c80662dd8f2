// The product of a distribution of directions and the cosine at a surface.
//                                                                        [Herholz et al. 2016; Clarberg et al. 2005]
//
// The cosine is a constant b_i in each of the 4 x 4 cells of the square of directions, and the density is
//
//   p(w) = p_g(w) b_i / sum over j of P_j b_j,        w in cell i,
//
// with the density p_g of the distribution and the probabilities P_j of its cells. Cells below an opaque surface get no
// samples.
#pragma once
#include "integrator/guiding/directional_tree.h"

namespace etendue::guiding {

// Which directions a surface scatters to.
enum class ScatteredSide { both, normal };

class CosineProduct {
 public:
  // `distribution` is referenced. `normal` is the unit normal of the surface, on the side of the light that is
  // scattered.
  void set(const DirectionalDistribution& distribution, const Vec3& normal, ScatteredSide side);

  // The density at p relative to that of the distribution.
  float factor(Vec2 p) const { return cosines_[descend_to_cell(p)] * inverse_total_; }
  // A point with the density of the product, for u uniform in the square.
  Vec2 sample(Vec2 u) const;

 private:
  const DirectionalDistribution* distribution_ = nullptr;
  alignas(64) std::array<float, kCells> cosines_;  // of the cells
  float inverse_total_ = 0;
};

}  // namespace etendue::guiding
