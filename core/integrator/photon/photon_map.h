// A balanced tree of photons.                              thesis 9.5, L18045-18049; Jensen 2001, 6.1; digest 8-10: S34
//
// A kd-tree without pointers: the photon with number i has its children at 2i and 2i + 1, which leaves no level but the
// last unfilled. Planes go through the median photon along the longest axis of the box around. n photons make
// ceil(log2(n + 1)) levels.
//
// It is built in pieces that may be built side by side: first the upper levels, then what hangs below them.
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

// The photons nearest to a point, and the disc that they lie in.
struct Neighbourhood {
  std::span<const Neighbour> photons;
  float radius2 = 0;
};

class PhotonMap {
 public:
  // The number of pieces after the first.
  static constexpr int kPieces = 16;

  // The tree of these photons; `begin`, then every `build_piece` in any order, then `end`.
  void begin(std::vector<Photon> photons);
  void build_piece(int piece);
  void end();
  // All of it at once.
  void build(std::vector<Photon> photons);

  size_t size() const { return tree_.empty() ? 0 : tree_.size() - 1; }
  // Number 0 is the root.
  const Photon& operator[](size_t i) const { return tree_[i + 1]; }
  std::span<const Photon> photons() const { return std::span(tree_).subspan(tree_.empty() ? 0 : 1); }
  size_t memory() const { return (tree_.capacity() + source_.capacity()) * sizeof(Photon); }
  // Gives back the photons' memory for the next ones.
  std::vector<Photon> take_memory();

  // The nearest `most` photons (one at least) that lie on a surface's continuation and are no farther than the root of
  // `farthest2`. The disc goes through the farthest of them, which is left out: so its density is estimated without
  // bias (O18). Photons beyond an edge, on the other side of a thin wall or behind it belong to another light. Where
  // there are fewer, the disc has the largest radius, or goes through the farthest if there is none. `found` is room to
  // work in.
  Neighbourhood nearest(const Vec3& position, const Vec3& normal, size_t count, float max_distance2,
                        std::vector<Neighbour>& found) const;

  // Calls `visit(photon, distance2)` for every photon within the radius that lies on the surface's continuation.
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

 private:
  using Corners = std::array<Vec3, 2>;
  struct Piece {
    size_t node = 0, first = 0, last = 0;
    Corners box;
  };

  // Whether a photon at the offset d may lie on the same surface: that faces about as there, and the photon is less
  // than 30 degrees above or below the plane. What curves does so within ever smaller discs.
  static bool is_on_same_surface(const Photon& photon, const Vec3& d, float distance2, const Vec3& normal) {
    return sqr(glm::dot(d, normal)) <= 0.25f * distance2 && photon.faces(normal);
  }

  // `look(photon, offset, distance2)` is called for what lies in cells that reach into the sphere, and returns its
  // squared radius from there on.
  template <class Visit>
  void search(const Vec3& position, Visit&& visit, float radius2) const;

  size_t split(const Piece& piece, Corners& left, Corners& right);
  void build_below(const Piece& piece, size_t levels);

  std::vector<Photon> source_, tree_;  // the tree begins at number 1
  std::vector<Piece> pieces_;
};

template <class Visit>
void PhotonMap::search(const Vec3& position, Visit&& visit, float radius2) const {
  struct Pending {
    size_t node;
    float distance2;  // of its plane
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
