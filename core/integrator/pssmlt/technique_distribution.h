// The probability of each technique and path length in the multiplexed form (pssmlt.cpp).
//
// It starts with a heavy-tailed distribution of lengths and a uniform choice of techniques, and is then learned, for
// the most part, from the contributions of bootstrap samples. A distribution never depends on the samples that are
// drawn from it, so that no mean is biased.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "integrator/pssmlt/primary_sample_paths.h"

namespace etendue::integrator {

// Path lengths with P(length > n) = 3 / (n + 3). The heavy tail covers energy that falls with the length, however
// slowly.
class PathLengths {
 public:
  // Longer paths do not survive Russian roulette in practice.
  static constexpr int kMaxLength = 1000;

  explicit PathLengths(int limit) : limit_(limit > 0 ? limit : kMaxLength) {
    total_ = 1 - kMedian / (static_cast<float>(limit_) + kMedian);
  }
  int draw(float u) const { return std::clamp(static_cast<int>(kMedian / (1 - u * total_) - kMedian) + 1, 1, limit_); }
  float probability(int length) const {
    const auto k = static_cast<float>(length);
    return kMedian / ((k - 1 + kMedian) * (k + kMedian) * total_);
  }

 private:
  static constexpr float kMedian = 3;  // half of all paths are no longer than this
  int limit_;
  float total_;
};

class TechniqueDistribution {
 public:
  // `max_length` is the largest number of edges; 0: no limit. A path of k edges has 0 to k + 1 vertices from the light;
  // k + 1 only if light subpaths can hit the lens.
  TechniqueDistribution(int max_length, bool lens_can_be_hit)
      : lengths_(max_length), extra_techniques_(lens_can_be_hit ? 2 : 1) {
    update();
  }

  struct Choice {
    Technique technique;
    float probability;
    uint16_t kind;  // index of technique and length, for add_weights
  };
  // Chooses the length with one random number and the technique with the other.
  Choice choose(float length, float technique) const {
    const int k = draw_length(length);
    float p = probability_of_length(k);
    int s = 0;
    const int count = k + extra_techniques_;
    if (k > kListedLengths) {
      s = std::min(static_cast<int>(technique * static_cast<float>(count)), count - 1);
      return {{s, k + 1 - s}, p / static_cast<float>(count), kUnlisted};
    }
    const Row& row = techniques_[static_cast<size_t>(k - 1)];
    while (s + 1 < count && !(technique < row[static_cast<size_t>(s)])) technique -= row[static_cast<size_t>(s++)];
    return {{s, k + 1 - s}, p * row[static_cast<size_t>(s)], static_cast<uint16_t>((k - 1) * kColumns + s)};
  }

  // Adds the weights of bootstrap samples of these kinds.
  void add_weights(std::span<const float> weights, std::span<const uint16_t> kinds) {
    for (size_t i = 0; i < weights.size(); ++i)
      if (kinds[i] != kUnlisted) weights_[kinds[i] / kColumns][kinds[i] % kColumns] += weights[i];
  }

  // Recomputes the probabilities from the weights added so far.
  void update() {
    float total = 0;
    std::array<float, kListedLengths> length_weight{};
    for (size_t k = 0; k < kListedLengths; ++k) {
      for (const float w : weights_[k]) length_weight[k] += w;
      total += length_weight[k];
    }
    learned_share_ = total > 0 ? kLearnedShare : 0;
    for (size_t k = 0; k < kListedLengths; ++k) {
      learned_lengths_[k] = total > 0 ? length_weight[k] / total : 0;
      const float even = 1 / static_cast<float>(static_cast<int>(k) + 1 + extra_techniques_);
      const float learned = length_weight[k] > 0 ? kLearnedShare : 0;
      for (size_t s = 0; s < kColumns; ++s)
        techniques_[k][s] = (1 - learned) * even + (learned > 0 ? learned * weights_[k][s] / length_weight[k] : 0);
    }
  }

 private:
  // Longer paths keep the initial distribution.
  static constexpr int kListedLengths = 16, kColumns = kListedLengths + 2;
  static constexpr uint16_t kUnlisted = UINT16_MAX;
  // Weight of the learned distribution in the mixture; it bounds how rare a technique can become.
  static constexpr float kLearnedShare = 0.75f;
  using Row = std::array<float, kColumns>;

  int draw_length(float u) const {
    if (!(u < learned_share_))
      return lengths_.draw(std::min((u - learned_share_) / (1 - learned_share_), kOneMinusEpsilon));
    u /= learned_share_;
    int k = 1, last = 1;  // the last that may be chosen, should rounding leave something over
    for (; k <= kListedLengths; ++k) {
      const float p = learned_lengths_[static_cast<size_t>(k - 1)];
      if (p > 0) last = k;
      if (u < p) return k;
      u -= p;
    }
    return last;
  }
  float probability_of_length(int k) const {
    const float learned = k <= kListedLengths ? learned_lengths_[static_cast<size_t>(k - 1)] : 0;
    return learned_share_ * learned + (1 - learned_share_) * lengths_.probability(k);
  }

  PathLengths lengths_;
  int extra_techniques_;     // number of techniques minus number of edges
  float learned_share_ = 0;  // weight of the learned lengths
  std::array<float, kListedLengths> learned_lengths_{};
  std::array<Row, kListedLengths> techniques_{};
  std::array<Row, kListedLengths> weights_{};  // sums of bootstrap weights
};

}  // namespace etendue::integrator
