#include "integrator/photon/photon_map.h"

#include <algorithm>
#include <utility>

#include "integrator/photon/hilbert_curve.h"

namespace etendue::photon {
namespace {

Cube cube_around(std::span<const Photon> photons) {
  Vec3 low(kInfinity), high(-kInfinity);
  for (const Photon& p : photons) {
    low = glm::min(low, p.position());
    high = glm::max(high, p.position());
  }
  const Vec3 size = high - low;
  return {low, std::max({size.x, size.y, size.z, std::numeric_limits<float>::min()})};
}

// Positions along the curve, in the order of the photons.
std::vector<uint64_t> curve_positions(std::span<const Photon> photons) {
  constexpr size_t kBatch = 256;
  const Cube cube = cube_around(photons);
  std::vector<uint64_t> positions(padded_lanes(photons.size()));
  Vec3Lanes<kBatch> points{};
  for (size_t first = 0; first < photons.size(); first += kBatch) {
    const size_t count = std::min(kBatch, photons.size() - first);
    for (size_t i = 0; i < count; ++i) points.set(i, photons[first + i].position());
    find_hilbert_positions(cube, points, count, positions.data() + first);
  }
  return positions;
}

// The squared radius of a disc for so many photons at the density of a leaf, whose box is flat on most surfaces.
float estimated_radius2(const Bounds& leaf, size_t count) {
  const Vec3 size = leaf.max - leaf.min;
  const float area = std::max({size.x * size.y, size.y * size.z, size.z * size.x});
  return static_cast<float>(count) / PhotonBlock::kSize * area / kPi;
}

Bounds box_of(const PhotonBlock& block, size_t count) {
  Bounds box;
  for (size_t i = 0; i < count; ++i) box.extend({block.x[i], block.y[i], block.z[i]});
  return box;
}

}  // namespace

// Sorts by the highest bits, and divides the photons into pieces between groups of equal bits.
void PhotonMap::begin(std::vector<Photon> photons) {
  constexpr int kBits = 12, kShift = kHilbertBits - kBits;
  source_ = std::move(photons);
  size_ = source_.size();
  blocks_.assign((size_ + PhotonBlock::kSize - 1) / PhotonBlock::kSize, {});
  order_.resize(size_);
  const std::vector<uint64_t> positions = curve_positions(source_);
  std::vector<size_t> ends((1U << kBits) + 1);
  for (size_t i = 0; i < size_; ++i) ++ends[(positions[i] >> kShift) + 1];
  for (size_t k = 1; k < ends.size(); ++k) ends[k] += ends[k - 1];
  for (size_t piece = 0; piece <= kPieces; ++piece)
    pieces_[piece] = *std::ranges::lower_bound(ends, piece * size_ / kPieces);
  for (size_t i = 0; i < size_; ++i) order_[ends[positions[i] >> kShift]++] = {positions[i], static_cast<uint32_t>(i)};
}

void PhotonMap::build_piece(int piece) {
  const size_t first = pieces_[static_cast<size_t>(piece)], last = pieces_[static_cast<size_t>(piece) + 1];
  std::sort(order_.begin() + static_cast<std::ptrdiff_t>(first), order_.begin() + static_cast<std::ptrdiff_t>(last));
  for (size_t i = first; i < last; ++i)
    blocks_[i / PhotonBlock::kSize].set(i % PhotonBlock::kSize, source_[order_[i].photon]);
}

void PhotonMap::end() {
  std::vector<Bounds> boxes(blocks_.size());
  for (size_t i = 0; i < boxes.size(); ++i)
    boxes[i] = box_of(blocks_[i], std::min(PhotonBlock::kSize, size_ - i * PhotonBlock::kSize));
  tree_.build(boxes);
  std::vector<Photon>().swap(source_);
  std::vector<Place>().swap(order_);
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

// The search starts within an estimated radius, which grows if there are too few photons. When there are twice as many
// as wanted, about the nearest half of them bounds the rest of the search.
template <class Find>
void PhotonMap::find_nearest_by(const Vec3& position, size_t count, float max_distance2, const Find& find,
                                Neighbourhood& nearest) const {
  nearest.begin(0);
  if (blocks_.empty()) return;
  constexpr float kMargin = 1.5f;
  constexpr int kMaxTrials = 4;
  float radius2 = kMargin * estimated_radius2(tree_.box(tree_.find_close(position)), count);
  for (int trial = 1; nearest.size() < count && nearest.radius2() < max_distance2; ++trial) {
    if (trial == kMaxTrials || !(radius2 < max_distance2)) radius2 = max_distance2;
    nearest.begin(radius2);
    tree_.visit_nearest(position, radius2, [&](uint32_t leaf) {
      BlockDistances distances2;
      find(blocks_[leaf], distances2);
      nearest.add(leaf, distances2);
      if (nearest.size() >= 2 * count) nearest.keep_nearest(count, count + count / 4);
      return nearest.radius2();
    });
    radius2 *= 4;
  }
  nearest.end(count);
}

template <class Find>
void PhotonMap::find_within_by(const Vec3& position, float radius2, const Find& find, Neighbourhood& found) const {
  found.begin(radius2);
  tree_.visit_within({position, position}, radius2, [&](uint32_t leaf) {
    BlockDistances distances2;
    find(blocks_[leaf], distances2);
    found.add(leaf, distances2);
  });
}

ETENDUE_VECTORIZE void PhotonMap::find_nearest(const Vec3& position, const Vec3& normal, size_t count,
                                               float max_distance2, Neighbourhood& nearest) const {
  find_nearest_by(
      position, count, max_distance2,
      [&](const PhotonBlock& block, BlockDistances& distances2) {
        find_distances_on_surface(block, position, normal, distances2);
      },
      nearest);
}

ETENDUE_VECTORIZE void PhotonMap::find_nearest_in_ball(const Vec3& position, size_t count, float max_distance2,
                                                       Neighbourhood& nearest) const {
  find_nearest_by(
      position, count, max_distance2,
      [&](const PhotonBlock& block, BlockDistances& distances2) { find_distances(block, position, distances2); },
      nearest);
}

ETENDUE_VECTORIZE void PhotonMap::find_within(const Vec3& position, const Vec3& normal, float radius2,
                                              Neighbourhood& found) const {
  find_within_by(
      position, radius2,
      [&](const PhotonBlock& block, BlockDistances& distances2) {
        find_distances_on_surface(block, position, normal, distances2);
      },
      found);
}

ETENDUE_VECTORIZE void PhotonMap::find_leaves(const Bounds& points, float distance2, LeafGroup& group) const {
  group.clear();
  tree_.visit_within(points, distance2, [&](uint32_t leaf) { group.add(leaf, tree_.box(leaf)); });
}

ETENDUE_VECTORIZE void PhotonMap::find_within(const LeafGroup& group, const Vec3& position, const Vec3& normal,
                                              float radius2, Neighbourhood& found) const {
  found.begin(radius2);
  for (size_t k = 0; k < group.boxes.size(); ++k) {
    BoxBlock::Distances box_distances2;
    group.boxes[k].find_distances({position, position}, box_distances2);
    for (uint32_t bits = bits_below(box_distances2, radius2); bits != 0; bits &= bits - 1) {
      const uint32_t leaf = group.leaves[k * BoxBlock::kSize + static_cast<size_t>(std::countr_zero(bits))];
      BlockDistances distances2;
      find_distances_on_surface(blocks_[leaf], position, normal, distances2);
      found.add(leaf, distances2);
    }
  }
}

ETENDUE_VECTORIZE void PhotonMap::find_within_ball(const Vec3& position, float radius2, Neighbourhood& found) const {
  find_within_by(
      position, radius2,
      [&](const PhotonBlock& block, BlockDistances& distances2) { find_distances(block, position, distances2); },
      found);
}

// The sums are an argument, because the compiler would not vectorise the loop with local ones.
ETENDUE_VECTORIZE void PhotonMap::add_powers_of(const Neighbourhood& found, const LambertianSide& side,
                                                PowerSums& sums) const {
  for (size_t k = 0; k < found.leaves().size(); ++k)
    add_powers(blocks_[found.leaves()[k]], found.distances2(k), found.radius2(), side, sums);
}

Rgb PhotonMap::sum_of_powers(const Neighbourhood& found, const LambertianSide& side) const {
  PowerSums sums;
  add_powers_of(found, side, sums);
  return sums.total();
}

}  // namespace etendue::photon
