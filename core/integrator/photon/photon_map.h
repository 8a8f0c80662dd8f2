// Photons in blocks of sixteen, under a tree of bounding boxes.                  [Lang, sec. 9.5; Jensen 2001, sec. 6.1]
//
// The photons are sorted along a Hilbert curve (hilbert_curve.h). Leaves are blocks of sixteen photons (photon_block.h).
// The nodes above them have sixteen children (box_tree.h). Lookups test sixteen boxes or photons at once. A balanced
// kd-tree takes longer to build, and its lookups take more decisions [docs/results/performance.md].
//
// The photons are divided into `kPieces` pieces of the curve, which are sorted in parallel.
#pragma once
#include <span>
#include <vector>

#include "integrator/photon/box_tree.h"
#include "integrator/photon/neighbourhood.h"
#include "integrator/photon/photon_block.h"

namespace etendue::photon {

// The leaves near a group of points, for lookups around these.
struct LeafGroup {
  std::vector<uint32_t> leaves;
  std::vector<BoxBlock> boxes;  // of sixteen leaves each

  void clear() {
    leaves.clear();
    boxes.clear();
  }
  void add(uint32_t leaf, const Bounds& box) {
    const size_t i = leaves.size() % BoxBlock::kSize;
    if (i == 0) boxes.emplace_back();
    boxes.back().set(i, box);
    leaves.push_back(leaf);
  }
};

class PhotonMap {
 public:
  // The number of pieces that can be sorted in parallel.
  static constexpr int kPieces = 16;

  // Builds the map: `begin`, then every `build_piece` in any order, then `end`.
  void begin(std::vector<Photon> photons);
  void build_piece(int piece);
  void end();
  // Builds the whole map.
  void build(std::vector<Photon> photons);

  size_t size() const { return size_; }
  // Photons are numbered by leaf.
  Photon operator[](size_t i) const { return blocks_[i / PhotonBlock::kSize][i % PhotonBlock::kSize]; }
  std::vector<Photon> photons() const;
  size_t memory() const {
    return source_.capacity() * sizeof(Photon) + order_.capacity() * sizeof(Place) +
           blocks_.capacity() * sizeof(PhotonBlock) + tree_.memory();
  }

  // The nearest `count` photons (at least one) on the same surface (distance2_on_surface) at less than the root of
  // `max_distance2`, but for the farthest of them, at which the disc ends. See Neighbourhood::end.
  void find_nearest(const Vec3& position, const Vec3& normal, size_t count, float max_distance2,
                    Neighbourhood& nearest) const;
  // The same with all photons, for photons in volumes: the region is a ball.
  void find_nearest_in_ball(const Vec3& position, size_t count, float max_distance2, Neighbourhood& nearest) const;

  // All photons within the radius that lie on the same surface, and all within it.
  void find_within(const Vec3& position, const Vec3& normal, float radius2, Neighbourhood& found) const;
  void find_within_ball(const Vec3& position, float radius2, Neighbourhood& found) const;

  // The leaves within a distance of the points of a box, and the photons of `find_within` for one of these points and a
  // radius of at most this distance. Points that are close to each other share the search of the tree.
  void find_leaves(const Bounds& points, float distance2, LeafGroup& group) const;
  void find_within(const LeafGroup& group, const Vec3& position, const Vec3& normal, float radius2,
                   Neighbourhood& found) const;

  // Calls `visit(photon, distance2)` for every photon that was found.
  template <class Visit>
  void for_each(const Neighbourhood& found, Visit&& visit) const {
    found.for_each([&](uint32_t leaf, size_t i, float distance2) { visit(blocks_[leaf][i], distance2); });
  }
  // The sum of the powers of those that a Lambertian surface reflects. All must be nearer than the radius
  // (Neighbourhood::is_open).
  Rgb sum_of_powers(const Neighbourhood& found, const LambertianSide& side) const;

 private:
  // A photon, and where it lies along the curve.
  struct Place {
    uint64_t position;
    uint32_t photon;

    bool operator<(const Place& other) const {
      return position != other.position ? position < other.position : photon < other.photon;
    }
  };

  void add_powers_of(const Neighbourhood& found, const LambertianSide& side, PowerSums& sums) const;
  // The nearest photons; find(block, distances2) computes the distances of those that count.
  template <class Find>
  void find_nearest_by(const Vec3& position, size_t count, float max_distance2, const Find& find,
                       Neighbourhood& nearest) const;
  template <class Find>
  void find_within_by(const Vec3& position, float radius2, const Find& find, Neighbourhood& found) const;

  std::vector<Photon> source_;
  std::vector<Place> order_;
  std::array<size_t, kPieces + 1> pieces_{};  // the first of each in `order_`, and the end
  std::vector<PhotonBlock> blocks_;
  BoxTree tree_;  // of the blocks
  size_t size_ = 0;
};

}  // namespace etendue::photon
