// A balanced kd-tree of photons.                                                [Lang, sec. 9.5; Jensen 2001, sec. 6.1]
//
// The tree is stored without pointers: the children of photon i are photons 2i and 2i + 1, so that all levels but the
// last are full. Splitting planes go through the median photon, perpendicular to the longest axis of the bounding box.
// n photons make ceil(log2(n + 1)) levels.
//
// The upper levels are built first; the subtrees below them are then built in parallel.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "integrator/photon/photon.h"

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

  size_t size() const { return tree_.empty() ? 0 : tree_.size() - 1; }
  // Photon 0 is the root.
  const Photon& operator[](size_t i) const { return tree_[i + 1]; }
  std::span<const Photon> photons() const { return std::span(tree_).subspan(tree_.empty() ? 0 : 1); }
  size_t memory() const { return (tree_.capacity() + source_.capacity()) * sizeof(Photon); }
  // Empties the map and returns its memory for reuse.
  std::vector<Photon> take_memory();

  // The nearest `count` photons (at least one) that lie on the same surface (is_on_same_surface) at no more than the
  // root of `max_distance2`. The disc ends at the farthest of them, which is excluded: including it would overestimate
  // the density by N / (N - 1). If there are fewer photons, the disc has the maximum radius, or ends at the farthest if
  // that is infinite. `found` is a buffer.
  Neighbourhood nearest(const Vec3& position, const Vec3& normal, size_t count, float max_distance2,
                        std::vector<Neighbour>& found) const;

  // The same with all photons, for photons in volumes: the region is a ball.
  Neighbourhood nearest_in_ball(const Vec3& position, size_t count, float max_distance2,
                                std::vector<Neighbour>& found) const;

  // Calls `visit(photon, distance2)` for every photon within the radius that lies on the same surface.
  template <class Visit>
  void for_each_within(const Vec3& position, const Vec3& normal, float radius2, Visit&& visit) const {
    search(
        position,
        [&](const Photon& photon, const Vec3& d, float distance2) {
          if (distance2 < radius2 && is_on_same_surface(photon, d, distance2, normal)) visit(photon, distance2);
          return radius2;
        },
        radius2);
  }
  // The same for every photon within the radius.
  template <class Visit>
  void for_each_in_ball(const Vec3& position, float radius2, Visit&& visit) const {
    search(
        position,
        [&](const Photon& photon, const Vec3&, float distance2) {
          if (distance2 < radius2) visit(photon, distance2);
          return radius2;
        },
        radius2);
  }

 private:
  using Corners = std::array<Vec3, 2>;
  struct Piece {
    size_t node = 0, first = 0, last = 0;
    Corners box;
  };

  // Whether a photon at the offset d can lie on the same surface: its normal is less than 60 degrees away, and it is
  // less than 30 degrees above or below the tangent plane. This excludes photons beyond edges and on the other side of
  // thin walls. On curved surfaces the criterion becomes exact as the disc shrinks.
  static bool is_on_same_surface(const Photon& photon, const Vec3& d, float distance2, const Vec3& normal) {
    return sqr(glm::dot(d, normal)) <= 0.25f * distance2 && photon.faces(normal);
  }

  // The nearest photons among those with is_selected(photon, offset, distance2); see `nearest`.
  template <class Selected>
  Neighbourhood nearest_selected(const Vec3& position, size_t count, float max_distance2, const Selected& is_selected,
                                 std::vector<Neighbour>& found) const;

  // Calls `visit(photon, offset, distance2)` for every photon in cells that overlap the sphere; it returns the squared
  // radius of the sphere from there on.
  template <class Visit>
  void search(const Vec3& position, Visit&& visit, float radius2) const;

  size_t split(const Piece& piece, Corners& left, Corners& right);
  void build_below(const Piece& piece, size_t levels);

  std::vector<Photon> source_, tree_;  // the root is tree_[1]
  std::vector<Piece> pieces_;
};

template <class Visit>
void PhotonMap::search(const Vec3& position, Visit&& visit, float radius2) const {
  struct Pending {
    size_t node;
    float distance2;  // to its splitting plane
  };
  std::array<Pending, 48> pending;
  size_t count = 0;
  const size_t end = tree_.size();
  for (size_t node = 1;;) {
    while (node < end) {
      const Photon& photon = tree_[node];
      const int axis = photon.axis();
      const float offset = position[axis] - photon.position()[axis];
      const bool right = offset > 0;
      if (sqr(offset) < radius2) pending[count++] = {node, sqr(offset)};
      node = 2 * node + (right ? 1 : 0);
    }
    while (true) {
      if (count == 0) return;
      const Pending next = pending[--count];
      if (!(next.distance2 < radius2)) continue;
      const Photon& photon = tree_[next.node];
      const Vec3 d = photon.position() - position;
      radius2 = visit(photon, d, glm::dot(d, d));
      if (!(next.distance2 < radius2)) continue;
      const int axis = photon.axis();
      node = 2 * next.node + (position[axis] - photon.position()[axis] > 0 ? 0 : 1);
      break;
    }
  }
}

}  // namespace etendue::photon
