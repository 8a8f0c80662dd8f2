#include "integrator/photon/photon_map.h"

#include <bit>
#include <utility>

namespace etendue::photon {
namespace {

// The number of photons in the left subtree of a tree of `count` photons with all levels but the last full.
size_t left_size(size_t count) {
  if (count <= 1) return 0;
  const size_t filled = std::bit_floor(count + 1) - 1;  // in the complete levels
  const size_t half = (filled - 1) / 2, last = count - filled, capacity = (filled + 1) / 2;
  return half + std::min(last, capacity);
}

// Orders a heap with the farthest neighbour first.
bool nearer(const Neighbour& a, const Neighbour& b) { return a.distance2 < b.distance2; }

// Replaces the farthest neighbour in the heap.
void replace_first(std::vector<Neighbour>& heap, const Neighbour& neighbour) {
  size_t slot = 0;
  for (size_t child = 1; child < heap.size(); child = 2 * slot + 1) {
    if (child + 1 < heap.size() && nearer(heap[child], heap[child + 1])) ++child;
    if (!nearer(neighbour, heap[child])) break;
    heap[slot] = heap[child];
    slot = child;
  }
  heap[slot] = neighbour;
}

}  // namespace

void PhotonMap::begin(std::vector<Photon> photons) {
  source_ = std::move(photons);
  tree_.resize(source_.empty() ? 0 : source_.size() + 1);
  pieces_.clear();
  if (source_.empty()) return;
  Corners box{source_[0].position(), source_[0].position()};
  for (const Photon& p : source_) {
    box[0] = glm::min(box[0], p.position());
    box[1] = glm::max(box[1], p.position());
  }
  build_below({1, 0, source_.size(), box}, std::bit_width(unsigned{kPieces}) - 1U);
}

// Stores the median along the longest axis as a node; the other photons are partitioned around it.
size_t PhotonMap::split(const Piece& piece, Corners& left, Corners& right) {
  const Vec3 size = piece.box[1] - piece.box[0];
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const size_t median = piece.first + left_size(piece.last - piece.first);
  const auto at = [&](size_t i) { return source_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(piece.first), at(median), at(piece.last),
                   [axis](const Photon& a, const Photon& b) { return a.position()[axis] < b.position()[axis]; });
  Photon& photon = tree_[piece.node] = source_[median];
  photon.set_axis(axis);
  left = right = piece.box;
  left[1][axis] = right[0][axis] = photon.position()[axis];
  return median;
}

void PhotonMap::build_below(const Piece& piece, size_t levels) {
  if (piece.first == piece.last) return;
  if (levels == 0) return pieces_.push_back(piece);
  Piece left{2 * piece.node, piece.first, 0, {}}, right{2 * piece.node + 1, 0, piece.last, {}};
  const size_t median = split(piece, left.box, right.box);
  left.last = median;
  right.first = median + 1;
  build_below(left, levels - 1);
  build_below(right, levels - 1);
}

void PhotonMap::build_piece(int piece) {
  if (static_cast<size_t>(piece) < pieces_.size()) build_below(pieces_[static_cast<size_t>(piece)], 64);
}

void PhotonMap::end() {
  pieces_.clear();
  source_.clear();
  source_.shrink_to_fit();
}

void PhotonMap::build(std::vector<Photon> photons) {
  begin(std::move(photons));
  for (int i = 0; i < kPieces; ++i) build_piece(i);
  end();
}

std::vector<Photon> PhotonMap::take_memory() {
  tree_.clear();
  return std::exchange(tree_, {});
}

template <class Selected>
Neighbourhood PhotonMap::nearest_selected(const Vec3& position, size_t count, float max_distance2,
                                          const Selected& is_selected, std::vector<Neighbour>& found) const {
  found.clear();
  float radius2 = max_distance2;
  search(
      position,
      [&](const Photon& photon, const Vec3& d, float distance2) {
        if (!(distance2 < radius2) || !is_selected(photon, d, distance2)) return radius2;
        const Neighbour neighbour{distance2, static_cast<uint32_t>(&photon - &tree_[1])};
        if (found.size() < count) {
          found.push_back(neighbour);
          if (found.size() < count) return radius2;
          std::make_heap(found.begin(), found.end(), nearer);
        } else {
          replace_first(found, neighbour);
        }
        return radius2 = found.front().distance2;
      },
      radius2);
  if (found.size() < count && std::isfinite(max_distance2)) return {found, max_distance2};
  if (found.empty()) return {};
  if (found.size() < count) std::iter_swap(found.begin(), std::max_element(found.begin(), found.end(), nearer));
  return {std::span(found).subspan(1), found.front().distance2};
}

Neighbourhood PhotonMap::nearest(const Vec3& position, const Vec3& normal, size_t count, float max_distance2,
                                 std::vector<Neighbour>& found) const {
  return nearest_selected(
      position, count, max_distance2,
      [&](const Photon& photon, const Vec3& d, float distance2) {
        return is_on_same_surface(photon, d, distance2, normal);
      },
      found);
}

Neighbourhood PhotonMap::nearest_in_ball(const Vec3& position, size_t count, float max_distance2,
                                         std::vector<Neighbour>& found) const {
  return nearest_selected(
      position, count, max_distance2, [](auto&&...) { return true; }, found);
}

}  // namespace etendue::photon
