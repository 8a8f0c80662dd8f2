#include "integrator/photon/photon_map.h"

#include <algorithm>
#include <utility>

namespace etendue::photon {
namespace {

// The number of leaves in the left subtree of a tree with all levels but the last full.
size_t leaves_on_the_left(size_t leaves) {
  const size_t full = std::bit_floor(leaves);  // leaves without the last level
  return full / 2 + std::min(leaves - full, full / 2);
}

size_t leaves_of(size_t photons) { return (photons + PhotonBlock::kSize - 1) / PhotonBlock::kSize; }

ETENDUE_VECTORIZE size_t count_within(const Neighbour* found, size_t size, float radius2) {
  uint32_t count = 0;
  for (size_t i = 0; i < size; ++i) count += found[i].distance2 < radius2 ? 1 : 0;
  return count;
}

// Removes the neighbours at or beyond a radius; the others keep their order. Returns their number.
size_t keep_within(std::span<Neighbour> found, float radius2) {
  size_t kept = 0;
  for (const Neighbour& n : found) {
    found[kept] = n;
    kept += n.distance2 < radius2 ? 1 : 0;  // without a branch, which would be unpredictable
  }
  return kept;
}

struct NearestGroup {
  size_t size;
  float radius2;  // all of them are nearer than this, and no other neighbour is
};

// Keeps the nearest neighbours: at least `least`, and at most `most` unless their distances are nearly equal. All must
// be nearer than `radius2`. Counting the neighbours within trial radii takes a few vector instructions each; sorting
// and partitioning take a misprediction for every other neighbour.
NearestGroup keep_nearest_group(std::span<Neighbour> found, size_t least, size_t most, float radius2) {
  constexpr int kMostTrials = 16;
  if (!std::isfinite(radius2)) {
    float farthest = 0;
    for (const Neighbour& n : found) farthest = std::max(farthest, n.distance2);
    radius2 = std::nextafter(farthest, kInfinity);
  }
  float inner = 0;
  size_t within_inner = 0, within = found.size();
  for (int trial = 0; trial < kMostTrials && within > most; ++trial) {
    // Squared distances to photons of constant density are uniform. Every other trial bisects for other densities.
    const float wanted = 0.5f * static_cast<float>(least + most) - static_cast<float>(within_inner);
    const float t = trial % 2 == 1 ? 0.5f : std::clamp(wanted / static_cast<float>(within - within_inner), 0.1f, 0.9f);
    const float middle = inner + (radius2 - inner) * t;
    const size_t count = count_within(found.data(), found.size(), middle);
    if (count >= least) {
      radius2 = middle;
      within = count;
    } else {
      inner = middle;
      within_inner = count;
    }
  }
  return {keep_within(found, radius2), radius2};
}

// Moves the nearest `count` neighbours to the front; returns the squared distance of the farthest of them, which
// becomes the last.
float keep_nearest(std::span<Neighbour> found, size_t count, float radius2) {
  const auto by_distance = [](const Neighbour& a, const Neighbour& b) { return a.distance2 < b.distance2; };
  const size_t size = keep_nearest_group(found, count, count, radius2).size;
  const auto last = found.begin() + static_cast<std::ptrdiff_t>(count) - 1;
  if (size > count)  // of equal distances
    std::nth_element(found.begin(), last, found.begin() + static_cast<std::ptrdiff_t>(size), by_distance);
  std::iter_swap(std::max_element(found.begin(), last + 1, by_distance), last);
  return last->distance2;
}

}  // namespace

void PhotonMap::begin(std::vector<Photon> photons) {
  source_ = std::move(photons);
  size_ = source_.size();
  const size_t leaves = leaves_of(size_);
  blocks_.assign(leaves, {});
  planes_.resize(leaves);
  pieces_.clear();
  if (source_.empty()) return;
  Corners box{source_[0].position(), source_[0].position()};
  for (const Photon& p : source_) {
    box[0] = glm::min(box[0], p.position());
    box[1] = glm::max(box[1], p.position());
  }
  build_below({1, 0, source_.size(), box}, std::bit_width(unsigned{kPieces}) - 1);
}

// Divides the photons between full leaves at the longest axis.
void PhotonMap::split(const Piece& piece, Piece& left, Piece& right) {
  const Vec3 size = piece.box[1] - piece.box[0];
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const size_t middle = piece.first + leaves_on_the_left(leaves_of(piece.last - piece.first)) * PhotonBlock::kSize;
  const auto at = [&](size_t i) { return source_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(piece.first), at(middle), at(piece.last),
                   [axis](const Photon& a, const Photon& b) { return a.position()[axis] < b.position()[axis]; });
  const float plane = source_[middle].position()[axis];
  planes_[piece.node] = {plane, static_cast<uint32_t>(axis)};
  left = {2 * piece.node, piece.first, middle, piece.box};
  right = {2 * piece.node + 1, middle, piece.last, piece.box};
  left.box[1][axis] = right.box[0][axis] = plane;
}

void PhotonMap::fill_leaf(const Piece& piece) {
  PhotonBlock& block = blocks_[leaf_number(piece.node)];
  for (size_t i = piece.first; i < piece.last; ++i) block.set(i - piece.first, source_[i]);
}

void PhotonMap::build_below(const Piece& piece, int levels) {
  if (piece.node >= blocks_.size()) return fill_leaf(piece);
  if (levels == 0) return pieces_.push_back(piece);
  Piece left, right;
  split(piece, left, right);
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

std::vector<Photon> PhotonMap::photons() const {
  std::vector<Photon> all;
  all.reserve(size_);
  for (size_t i = 0; i < size_; ++i) all.push_back((*this)[i]);
  return all;
}

// Candidates are collected until there are twice as many as wanted; about the nearest half of them then bounds the
// search.
template <class Find>
Neighbourhood PhotonMap::nearest_by(const Vec3& position, size_t count, float max_distance2, const Find& find,
                                    std::vector<Neighbour>& found) const {
  const size_t full = std::min(2 * count, size_ + 1), most = count + count / 4;
  if (found.size() < full + PhotonBlock::kSize) found.resize(full + PhotonBlock::kSize);
  float radius2 = max_distance2;
  size_t n = 0;
  search(position, radius2, [&](size_t leaf) {
    BlockDistances distances2;
    find(blocks_[leaf], distances2);
    for (size_t i = 0; i < PhotonBlock::kSize; ++i) {
      found[n] = {distances2[i], static_cast<uint32_t>(leaf * PhotonBlock::kSize + i)};
      n += distances2[i] < radius2 ? 1 : 0;  // without a branch, which would be unpredictable
    }
    if (n < full) return radius2;
    const auto all = std::span(found).first(n);
    const NearestGroup group = keep_nearest_group(all, count, most, radius2);
    n = group.size;
    radius2 = group.radius2;
    if (n > most) {  // of nearly equal distances
      radius2 = keep_nearest(all.first(n), count, radius2);
      n = count;
    }
    return radius2;
  });
  const auto all = std::span(found).first(n);
  if (n < count && std::isfinite(max_distance2)) return {all, max_distance2};
  if (n == 0) return {};
  const float radius = keep_nearest(all, std::min(count, n), radius2);
  return {all.first(std::min(count, n) - 1), radius};
}

Neighbourhood PhotonMap::nearest(const Vec3& position, const Vec3& normal, size_t count, float max_distance2,
                                 std::vector<Neighbour>& found) const {
  return nearest_by(
      position, count, max_distance2,
      [&](const PhotonBlock& block, BlockDistances& distances2) {
        find_distances_on_surface(block, position, normal, distances2);
      },
      found);
}

Neighbourhood PhotonMap::nearest_in_ball(const Vec3& position, size_t count, float max_distance2,
                                         std::vector<Neighbour>& found) const {
  return nearest_by(
      position, count, max_distance2,
      [&](const PhotonBlock& block, BlockDistances& distances2) { find_distances(block, position, distances2); },
      found);
}

}  // namespace etendue::photon
