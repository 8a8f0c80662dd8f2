#include "integrator/photon/neighbourhood.h"

#include <algorithm>
#include <cmath>

namespace etendue::photon {
namespace {

ETENDUE_VECTORIZE size_t count_below(const float* distances2, size_t count, float radius2) {
  uint32_t below = 0;
  for (size_t i = 0; i < count; ++i) below += distances2[i] < radius2 ? 1 : 0;
  return below;
}

// Of non-negative values.
ETENDUE_VECTORIZE float most_below(const float* distances2, size_t count, float radius2) {
  std::array<float, kMaxLanes> most{};
  for (size_t i = 0; i < count; i += kMaxLanes)
    for (size_t k = 0; k < kMaxLanes; ++k)
      most[k] = distances2[i + k] < radius2 && most[k] < distances2[i + k] ? distances2[i + k] : most[k];
  for (size_t half = kMaxLanes / 2; half > 0; half /= 2)
    for (size_t k = 0; k < half; ++k) most[k] = most[k] < most[k + half] ? most[k + half] : most[k];
  return most[0];
}

}  // namespace

void Neighbourhood::begin(float radius2) {
  leaf_count_ = size_ = on_border_ = 0;
  max_leaves_ = kSpareLeaves;
  radius2_ = radius2;
}

void Neighbourhood::grow() {
  const size_t size = std::max<size_t>(64, 2 * leaves_.size());
  leaves_.resize(size);
  distances2_.resize(size);
}

size_t Neighbourhood::count_within(float radius2) const {
  return leaf_count_ == 0 ? 0 : count_below(distances2_[0].values.data(), leaf_count_ * PhotonBlock::kSize, radius2);
}

float Neighbourhood::farthest_within(float radius2) const {
  return leaf_count_ == 0 ? 0 : most_below(distances2_[0].values.data(), leaf_count_ * PhotonBlock::kSize, radius2);
}

void Neighbourhood::shrink(size_t least, size_t most) {
  constexpr int kMaxTrials = 16;
  if (!std::isfinite(radius2_)) radius2_ = std::nextafter(farthest_within(kInfinity), kInfinity);
  float inner = 0;
  size_t within_inner = 0;
  for (int trial = 0; trial < kMaxTrials && size_ > most; ++trial) {
    // Squared distances to photons of constant density are uniform. Every other trial bisects for other densities.
    const float missing = 0.5f * static_cast<float>(least + most) - static_cast<float>(within_inner);
    const float t = trial % 2 == 1 ? 0.5f : std::clamp(missing / static_cast<float>(size_ - within_inner), 0.1f, 0.9f);
    const float middle = inner + (radius2_ - inner) * t;
    const size_t count = count_within(middle);
    if (count >= least) {
      radius2_ = middle;
      size_ = count;
    } else {
      inner = middle;
      within_inner = count;
    }
  }
}

void Neighbourhood::keep_exactly(size_t count) {
  std::vector<float> all;
  all.reserve(size_);
  for (size_t k = 0; k < leaf_count_; ++k)
    std::ranges::copy_if(distances2_[k].values, std::back_inserter(all), [&](float d) { return d < radius2_; });
  const auto last = all.begin() + static_cast<std::ptrdiff_t>(count) - 1;
  std::ranges::nth_element(all, last);
  const float farthest = *last;
  size_t at_farthest = count - count_within(farthest);
  for (size_t k = 0; k < leaf_count_; ++k)
    for (float& distance2 : distances2_[k].values)
      if (distance2 > farthest || (distance2 == farthest && at_farthest-- == 0)) distance2 = kInfinity;
  radius2_ = std::nextafter(farthest, kInfinity);
  size_ = count;
}

// Seldom, because it takes longer than counting.
void Neighbourhood::remove_leaves_outside() {
  size_t kept = 0;
  for (size_t k = 0; k < leaf_count_; ++k) {
    leaves_[kept] = leaves_[k];
    distances2_[kept] = distances2_[k];
    kept += bits_below(distances2_[k].values, radius2_) != 0 ? 1 : 0;
  }
  leaf_count_ = kept;
  max_leaves_ = kSpareLeaves + 2 * kept;
}

void Neighbourhood::keep_nearest(size_t least, size_t most) {
  shrink(least, most);
  if (size_ > most) keep_exactly(least);  // of nearly equal distances
  if (leaf_count_ > max_leaves_) remove_leaves_outside();
}

void Neighbourhood::end(size_t count) {
  if (size_ == 0 || (size_ < count && std::isfinite(radius2_))) return;
  count = std::min(count, size_);
  shrink(count, count);
  if (size_ > count) keep_exactly(count);  // of equal distances
  radius2_ = farthest_within(radius2_);
  size_ = count - 1;
  on_border_ = size_ - count_within(radius2_);
}

}  // namespace etendue::photon
