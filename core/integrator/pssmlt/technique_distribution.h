// How often the multiplexed form (pssmlt.h) tries each technique of paths of each length.
//
// At first as often as is safe for all; then, for the most part, in proportion to what candidates have found that it
// brings. A law never follows from the candidates that are drawn by it, so that no mean depends on it.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "integrator/pssmlt/primary_sample_paths.h"

namespace etendue::integrator {

// How long a path is: P(length > n) falls as 3 / (n + 3), so that no energy that falls with the length, however slowly,
// is looked for too seldom.
class PathLengths {
 public:
  // As long as any walk gets, with roulette.
  static constexpr int kLongest = 1000;

  explicit PathLengths(int limit) : limit_(limit > 0 ? limit : kLongest) {
    all_ = 1 - kHalf / (static_cast<float>(limit_) + kHalf);
  }
  int draw(float u) const { return std::clamp(static_cast<int>(kHalf / (1 - u * all_) - kHalf) + 1, 1, limit_); }
  float probability(int length) const {
    const auto k = static_cast<float>(length);
    return kHalf / ((k - 1 + kHalf) * (k + kHalf) * all_);
  }

 private:
  static constexpr float kHalf = 3;  // half of all are no longer than this
  int limit_;
  float all_;
};

class TechniqueDistribution {
 public:
  // Of paths of so many edges at most, 0 being no limit. A path of k edges can be found with 0 to k + 1 vertices from
  // the light, all of them only where walks may fall onto the lens.
  TechniqueDistribution(int longest, bool lens_can_be_hit) : lengths_(longest), most_more_(lens_can_be_hit ? 2 : 1) {
    renew();
  }

  struct Choice {
    Technique technique;
    float probability;
    uint16_t kind;  // of technique and length, for note()
  };
  // The length follows from one number, the technique among those of the length from the other.
  Choice choose(float length, float technique) const {
    const int k = draw_length(length);
    float p = probability_of_length(k);
    int s = 0;
    const int count = k + most_more_;
    if (k > kListed) {
      s = std::min(static_cast<int>(technique * static_cast<float>(count)), count - 1);
      return {{s, k + 1 - s}, p / static_cast<float>(count), kUnlisted};
    }
    const Row& row = techniques_[static_cast<size_t>(k - 1)];
    while (s + 1 < count && !(technique < row[static_cast<size_t>(s)])) technique -= row[static_cast<size_t>(s++)];
    return {{s, k + 1 - s}, p * row[static_cast<size_t>(s)], static_cast<uint16_t>((k - 1) * kColumns + s)};
  }

  // What candidates of these kinds were worth.
  void note(std::span<const float> weight, std::span<const uint16_t> kinds) {
    for (size_t i = 0; i < weight.size(); ++i)
      if (kinds[i] != kUnlisted) found_[kinds[i] / kColumns][kinds[i] % kColumns] += weight[i];
  }

  // Makes the law follow what was noted.
  void renew() {
    float all = 0;
    std::array<float, kListed> of_length{};
    for (size_t k = 0; k < kListed; ++k) {
      for (const float w : found_[k]) of_length[k] += w;
      all += of_length[k];
    }
    learned_ = all > 0 ? kLearned : 0;
    for (size_t k = 0; k < kListed; ++k) {
      learned_lengths_[k] = all > 0 ? of_length[k] / all : 0;
      const float even = 1 / static_cast<float>(static_cast<int>(k) + 1 + most_more_);
      const float learned = of_length[k] > 0 ? kLearned : 0;
      for (size_t s = 0; s < kColumns; ++s)
        techniques_[k][s] = (1 - learned) * even + (learned > 0 ? learned * found_[k][s] / of_length[k] : 0);
    }
  }

 private:
  // Longer paths follow the first law.
  static constexpr int kListed = 16, kColumns = kListed + 2;
  static constexpr uint16_t kUnlisted = UINT16_MAX;
  // Share of what was learned: nothing becomes much rarer than it was.
  static constexpr float kLearned = 0.75f;
  using Row = std::array<float, kColumns>;

  int draw_length(float u) const {
    if (!(u < learned_)) return lengths_.draw(std::min((u - learned_) / (1 - learned_), kOneMinusEpsilon));
    u /= learned_;
    int k = 1, last = 1;  // the last that may be chosen, should rounding leave something over
    for (; k <= kListed; ++k) {
      const float p = learned_lengths_[static_cast<size_t>(k - 1)];
      if (p > 0) last = k;
      if (u < p) return k;
      u -= p;
    }
    return last;
  }
  float probability_of_length(int k) const {
    const float learned = k <= kListed ? learned_lengths_[static_cast<size_t>(k - 1)] : 0;
    return learned_ * learned + (1 - learned_) * lengths_.probability(k);
  }

  PathLengths lengths_;
  int most_more_;      // techniques than edges
  float learned_ = 0;  // share of what was learned about lengths
  std::array<float, kListed> learned_lengths_{};
  std::array<Row, kListed> techniques_{};
  std::array<Row, kListed> found_{};  // worth of candidates
};

}  // namespace etendue::integrator
