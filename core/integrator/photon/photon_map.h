// A balanced kd-tree with photons in its leaves.                                [Lang, sec. 9.5; Jensen 2001, sec. 6.1]
//
// Leaves are blocks of sixteen photons (photon_block.h), all full but the last one. The tree is stored without
// pointers: the children of node i are nodes 2i and 2i + 1, so that all levels but the last are full. Splitting planes
// are perpendicular to the longest axis of the bounding box. Lookups visit the nearer half first, and leaf by leaf test
// sixteen photons at once.
//
// The upper levels are built first; the subtrees below them are then built in parallel.
#pragma once
#include <array>
#include <bit>
#include <span>
#include <vector>

#include "integrator/photon/photon_block.h"

namespace etendue::photon {

// A photon near a point.
struct Neighbour {
  float distance2;
  uint32_t photon;
};

// The photons nearest to a point, and the disc or ball that they lie in.
struct Neighbourhood {
  std::span<const Neighbour> photons;
  float radius2 = 0;
};

class PhotonMap {
 public:
  // The number of subtrees that can be built in parallel.
  static constexpr int kPieces = 16;

  // Builds the tree: `begin`, then every `build_piece` in any order, then `end`.
  void begin(std::vector<Photon> photons);
  void build_piece(int piece);
  void end();
  // Builds the whole tree.
  void build(std::vector<Photon> photons);

  size_t size() const { return size_; }
  // Photons are numbered by leaf.
  Photon operator[](size_t i) const { return blocks_[i / PhotonBlock::kSize][i % PhotonBlock::kSize]; }
  std::vector<Photon> photons() const;
  size_t memory() const {
    return source_.capacity() * sizeof(Photon) + blocks_.capacity() * sizeof(PhotonBlock) +
           planes_.capacity() * sizeof(Plane);
  }

  // The nearest `count` photons (at least one) that lie on the same surface (find_distances_on_surface) at no more than
  // the root of `max_distance2`. The disc ends at the farthest of them, which is excluded: including it would
  // overestimate the density by N / (N - 1). If there are fewer photons, the disc has the maximum radius, or ends at
  // the farthest if that is infinite. `found` is a buffer.
  Neighbourhood nearest(const Vec3& position, const Vec3& normal, size_t count, float max_distance2,
                        std::vector<Neighbour>& found) const;

  // The same with all photons, for photons in volumes: the region is a ball.
  Neighbourhood nearest_in_ball(const Vec3& position, size_t count, float max_distance2,
                                std::vector<Neighbour>& found) const;

  // Calls `visit(photon, distance2)` for every photon within the radius that lies on the same surface.
  template <class Visit>
  void for_each_within(const Vec3& position, const Vec3& normal, float radius2, Visit&& visit) const {
    for_each_by(
        position, radius2,
        [&](const PhotonBlock& block, BlockDistances& distances2) {
          find_distances_on_surface(block, position, normal, distances2);
        },
        visit);
  }
  // The sum of the powers of the photons that a lookup selects.
  Rgb sum_of_powers(const LambertianLookup& lookup) const {
    PowerSums sums;
    search(lookup.position, lookup.radius2, [&](size_t leaf) {
      add_powers(blocks_[leaf], lookup, sums);
      return lookup.radius2;
    });
    return sums.total();
  }
  // Calls `visit(photon, distance2)` for every photon within the radius.
  template <class Visit>
  void for_each_in_ball(const Vec3& position, float radius2, Visit&& visit) const {
    for_each_by(
        position, radius2,
        [&](const PhotonBlock& block, BlockDistances& distances2) { find_distances(block, position, distances2); },
        visit);
  }

 private:
  using Corners = std::array<Vec3, 2>;
  struct Piece {
    size_t node = 1, first = 0, last = 0;  // photons of `source_`
    Corners box;
  };
  struct Plane {
    float position = 0;
    uint32_t axis = 0;
  };

  // The nearest photons; find(block, distances2) computes the distances of those that count.
  template <class Find>
  Neighbourhood nearest_by(const Vec3& position, size_t count, float max_distance2, const Find& find,
                           std::vector<Neighbour>& found) const;
  template <class Find, class Visit>
  void for_each_by(const Vec3& position, float radius2, const Find& find, Visit&& visit) const;

  // Calls `visit(number)` for every leaf that overlaps the ball, nearer ones first; it returns the squared radius of
  // the ball from there on.
  template <class Visit>
  void search(const Vec3& position, float radius2, Visit&& visit) const;

  // Nodes 1 to n - 1 of a tree with n leaves are split, nodes n to 2n - 1 are leaves; those of the last level are first
  // from left to right.
  size_t leaf_number(size_t node) const {
    const size_t leaves = blocks_.size(), last_level = std::bit_ceil(leaves);
    return node >= last_level ? node - last_level : node + leaves - last_level;
  }
  void split(const Piece& piece, Piece& left, Piece& right);
  void fill_leaf(const Piece& piece);
  void build_below(const Piece& piece, int levels);

  std::vector<Photon> source_;
  std::vector<Plane> planes_;  // by node; planes_[0] is unused
  std::vector<PhotonBlock> blocks_;
  std::vector<Piece> pieces_;
  size_t size_ = 0;
};

template <class Visit>
void PhotonMap::search(const Vec3& position, float radius2, Visit&& visit) const {
  // A part of the tree that is still to be visited, and the distance to its box along each axis.
  struct Pending {
    size_t node;
    float distance2;  // at most that of its photons
    Vec3 offsets;
  };
  std::array<Pending, 48> pending;
  constexpr float kBelowRounding = 1 - 1e-5f;
  if (blocks_.empty()) return;
  const size_t leaves = blocks_.size();
  size_t count = 0;
  Pending here{1, 0, Vec3(0)};
  while (true) {
    while (here.node < leaves) {
      const Plane& plane = planes_[here.node];
      const auto axis = static_cast<int>(plane.axis);
      const float offset = position[axis] - plane.position;
      const size_t near = 2 * here.node + (offset > 0 ? 1 : 0);
      Pending far{near ^ 1, 0, here.offsets};
      far.offsets[axis] = offset;
      far.distance2 = kBelowRounding * glm::dot(far.offsets, far.offsets);
      if (far.distance2 < radius2) pending[count++] = far;
      here.node = near;
    }
    radius2 = visit(leaf_number(here.node));
    do {
      if (count == 0) return;
      here = pending[--count];
    } while (!(here.distance2 < radius2));
  }
}

template <class Find, class Visit>
void PhotonMap::for_each_by(const Vec3& position, float radius2, const Find& find, Visit&& visit) const {
  search(position, radius2, [&](size_t leaf) {
    const PhotonBlock& block = blocks_[leaf];
    BlockDistances distances2;
    find(block, distances2);
    for (size_t i = 0; i < PhotonBlock::kSize; ++i)
      if (distances2[i] < radius2) visit(block[i], distances2[i]);
    return radius2;
  });
}

}  // namespace etendue::photon
