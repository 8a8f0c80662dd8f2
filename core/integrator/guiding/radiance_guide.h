// The incident radiance of a scene as it is learned while rendering: a binary tree over space whose leaves, the regions,
// hold quadtrees of directions.                                                                   [Müller et al. 2017]
//
// A path that is sampled in a direction w with the density p adds an estimate of L_i(x, w) / p to its region. After an
// iteration, the sums of each region become its distribution, and both trees are refined for the next iteration. The
// result depends on the order of the records within each region only.
//
// Each region also learns the fraction c of directions that are sampled by the guide [Müller 2019]. The
// density of the mixture is p = (1 - c) p_b + c p_g. The Kullback-Leibler divergence to the integrand f_s L cos has the
// derivative and the second derivative
//
//   - E[ v (p_g - p_b) / p ],    E[ v ((p_g - p_b) / p)^2 ],      v = f_s L cos / p
//
// which are estimated from the same samples, and c makes one step of Newton's method per iteration.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/state_bytes.h"
#include "integrator/guiding/directional_tree.h"

namespace etendue::guiding {

// What one scattering event adds to a region.
struct Record {
  uint32_t region;
  Vec2 direction;   // on the unit square, by the equal-area map
  float radiance;   // of the direction over the density of its sample
  float slope;      // v (p_g - p_b) / p
  float curvature;  // v ((p_g - p_b) / p)^2
};

// One leaf of the binary tree.
struct Region {
  DirectionalDistribution guide;  // of the last iteration
  DirectionalSums sums;           // of this iteration
  float fraction = 0;             // of directions that are sampled by the guide
  double slope = 0, curvature = 0;
  double radiance = 0, squares = 0;  // sums over the records
  uint64_t records = 0;
  float flux = 0;           // the integral of the radiance over all directions in the last iteration; 0: no guide
  Vec3 corner{0}, size{0};  // of its box, metres

  bool is_ready() const { return flux > 0; }
  // The density of the guide per solid angle.
  float guide_pdf(Vec2 square) const { return guide.pdf(square) * (0.25f * kInvPi); }
  // The density of the mixture of BSDF and guide.
  float mixture(float bsdf_pdf, float guided_pdf) const { return (1 - fraction) * bsdf_pdf + fraction * guided_pdf; }
  // The number of records of equal weight that have the variance of the records.
  double effective_records() const { return squares > 0 ? radiance * radiance / squares : 0; }
  void add(const Record& record) {
    ++records;
    if (record.radiance == 0) return;
    sums.add(record.direction, record.radiance);
    slope += record.slope;
    curvature += record.curvature;
    radiance += record.radiance;
    squares += double{record.radiance} * record.radiance;
  }
};

class RadianceGuide {
 public:
  // Bounds of the learned fraction: it must stay below one, because the guide has no density where it has seen no light.
  static constexpr float kMinFraction = 0.05f, kMaxFraction = 0.9f;

  // One region, a box with this lower corner. `learns_fraction`: else all regions keep `fraction`.
  RadianceGuide(const Vec3& corner, const Vec3& size, bool learns_fraction, float fraction);

  uint32_t region_at(const Vec3& position) const {
    const Node* node = nodes_.data();
    while (node->axis >= 0) node = &nodes_[node->child[position[node->axis] >= node->middle ? 1 : 0]];
    return node->child[0];
  }
  const Region& region(uint32_t index) const { return regions_[index]; }
  size_t region_count() const { return regions_.size(); }

  // Records of different regions may be added at the same time.
  void add(const Record& record) { regions_[record.region].add(record); }

  // Makes the sums the distributions of the next iteration, and refines the trees. A region is divided if it has more
  // records than `most_records`.
  void end_iteration(uint64_t most_records);

  size_t memory() const;
  void write(StateWriter& out) const;
  // False if the bytes are no state; the guide is then undefined.
  bool read(StateReader& in);

 private:
  static constexpr size_t kMaxRegions = 1 << 16;
  // Divides its box in the middle of `axis`, or is a leaf, whose region is child[0].
  struct Node {
    int32_t axis = -1;
    float middle = 0;
    std::array<uint32_t, 2> child{};
  };
  void divide(uint32_t node, uint64_t most_records);
  void update(Region& region) const;
  void update_fraction(Region& region) const;

  bool learns_fraction_;
  std::vector<Node> nodes_;
  std::vector<Region> regions_;
};

}  // namespace etendue::guiding
