// The probability of each set of techniques in the multiplexed form (pssmlt.cpp).
//
// A set has all techniques with s vertices from the light and at least two from the camera, for paths of all lengths, or
// all with one vertex on the lens, or all that hit the lens. The probabilities start with a heavy-tailed distribution of
// s and are then learned, for the most part, from the contributions of bootstrap samples. A distribution never depends on
// the samples that are drawn from it, so that no mean is biased.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "integrator/bdpt/techniques.h"
#include "sampling/sampler.h"

namespace etendue::integrator {

// Counts of vertices from the light with P(s > n) = 3 / (n + 4). The heavy tail covers energy that falls with the
// count, however slowly.
class LightVertexCounts {
 public:
  // Longer subpaths do not survive Russian roulette in practice.
  static constexpr int kMost = 1000;

  // `limit` is the largest count.
  explicit LightVertexCounts(int limit) : limit_(limit) {
    total_ = 1 - kMedian / (static_cast<float>(limit_) + 1 + kMedian);
  }
  int draw(float u) const { return std::clamp(static_cast<int>(kMedian / (1 - u * total_) - kMedian), 0, limit_); }
  float probability(int s) const {
    const auto k = static_cast<float>(s);
    return kMedian / ((k + kMedian) * (k + 1 + kMedian) * total_);
  }

 private:
  static constexpr float kMedian = 3;  // half of all counts are smaller than this
  int limit_;
  float total_;
};

class TechniqueDistribution {
 public:
  // `max_length` is the largest number of edges of a path; 0: no limit.
  TechniqueDistribution(int max_length, bool lens_can_be_hit)
      : counts_((max_length > 0 ? std::min(max_length, LightVertexCounts::kMost) : LightVertexCounts::kMost) - 1),
        share_of_lens_hits_(lens_can_be_hit ? kShareOfLensHits : 0) {}

  struct Choice {
    Technique techniques;
    float probability;
    uint16_t kind;  // for add_weights
  };
  // Chooses a set of techniques by a number in [0, 1).
  Choice choose(float u) const {
    uint16_t kind = kLightTracing;
    int s = 0;
    if (u < learned_share_) {
      kind = draw_learned(u / learned_share_);
      s = kind - kCameraPaths;
    } else {
      u = std::min((u - learned_share_) / (1 - learned_share_), kOneMinusEpsilon);
      if (u < kShareOfLightTracing) {
        kind = kLightTracing;
      } else if (u < kShareOfLightTracing + share_of_lens_hits_) {
        kind = kLensHits;
      } else {
        s = counts_.draw(
            std::min((u - kShareOfLightTracing - share_of_lens_hits_) / share_of_camera_paths(), kOneMinusEpsilon));
        kind = s < kListedCounts ? static_cast<uint16_t>(kCameraPaths + s) : kUnlisted;
      }
    }
    const float learned = kind == kUnlisted ? 0 : learned_[kind];
    const float probability = learned_share_ * learned + (1 - learned_share_) * initial_probability(kind, s);
    return {techniques_of(kind, s), probability, kind};
  }

  // Adds the weights of bootstrap samples of these kinds.
  void add_weights(std::span<const float> weights, std::span<const uint16_t> kinds) {
    for (size_t i = 0; i < weights.size(); ++i)
      if (kinds[i] != kUnlisted) weights_[kinds[i]] += weights[i];
  }

  // Recomputes the probabilities from the weights added so far.
  void update() {
    float total = 0;
    for (const float w : weights_) total += w;
    learned_share_ = total > 0 ? kLearnedShare : 0;
    for (size_t kind = 0; kind < weights_.size(); ++kind) learned_[kind] = total > 0 ? weights_[kind] / total : 0;
  }

 private:
  // Larger counts keep their initial probability.
  static constexpr int kListedCounts = 16;
  static constexpr uint16_t kLightTracing = 0, kLensHits = 1, kCameraPaths = 2, kUnlisted = UINT16_MAX;
  // Weight of the learned distribution in the mixture; it bounds how rare a set can become.
  static constexpr float kLearnedShare = 0.75f;
  // Of the initial distribution.
  static constexpr float kShareOfLightTracing = 0.15f, kShareOfLensHits = 0.1f;

  static Technique techniques_of(uint16_t kind, int s) {
    if (kind == kLightTracing) return {Technique::kAny, 1};
    if (kind == kLensHits) return {Technique::kAny, 0};
    return {s, Technique::kAny};
  }
  float share_of_camera_paths() const { return 1 - kShareOfLightTracing - share_of_lens_hits_; }
  float initial_probability(uint16_t kind, int s) const {
    if (kind == kLightTracing) return kShareOfLightTracing;
    if (kind == kLensHits) return share_of_lens_hits_;
    return share_of_camera_paths() * counts_.probability(s);
  }

  uint16_t draw_learned(float u) const {
    uint16_t last = 0;  // the last that may be chosen, should rounding leave something over
    for (uint16_t kind = 0; kind < learned_.size(); ++kind) {
      if (learned_[kind] > 0) last = kind;
      if (u < learned_[kind]) return kind;
      u -= learned_[kind];
    }
    return last;
  }

  LightVertexCounts counts_;
  float share_of_lens_hits_;
  float learned_share_ = 0;                                                // weight of the learned probabilities
  std::array<float, kCameraPaths + kListedCounts> learned_{}, weights_{};  // by kind
};

}  // namespace etendue::integrator
