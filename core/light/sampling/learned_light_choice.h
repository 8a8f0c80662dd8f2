// Probabilities of groups of lights for the regions of a scene, learned from samples.
//
// Powers and the bounds of the light tree do not know what is visible: the sun has most of the power, but a room with a
// small window receives nearly all of its light from the lights inside. Samples at the vertices of a few paths show what the groups
// contribute. With one light sample per receiver, group g chosen with probability p_g and contributing c_g, the variance is
// smallest if p_g is proportional to the root of the mean of c_g^2. Here c_g is relative to all light of its receiver, with
// an estimate of the indirect light, so that receivers in shadow count as much as those in the sun.
//
// Regions are the cells of a grid. Cells with few samples have the probabilities of the whole scene. Every group keeps a
// probability above zero everywhere, so estimates stay unbiased. The idea of learned choices per region is that of
// [Vévoda et al. 2018].
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace etendue {

// Receivers of light, and samples of what each group contributes to them.
struct LightContributions {
  // The mean of the samples, and that of the squares of their products with their MIS weights against BSDF samples; finite.
  struct Moments {
    float mean = 0, square = 0;
  };

  explicit LightContributions(size_t group_count) : groups(group_count) {}
  void add_receivers(size_t count) {
    receivers.resize(receivers.size() + count);
    moments.resize(receivers.size() * groups);
    others.resize(receivers.size());
  }
  std::span<const Moments> of_receiver(size_t i) const { return std::span(moments).subspan(i * groups, groups); }

  size_t groups;
  std::vector<Vec3> receivers;
  std::vector<Moments> moments;  // of receiver i and group g at i * groups + g
  std::vector<float> others;     // direct light of receivers that light samples leave to BSDF samples
};

class LearnedLightChoice {
 public:
  struct Group {
    size_t index;
    float probability;
    float rest;  // a uniform random number in [0, 1), independent of the choice
  };

  explicit LearnedLightChoice(const LightContributions& contributions);

  size_t group_count() const { return groups_; }
  Group choose(const Vec3& receiver, float u) const;
  float probability(size_t group, const Vec3& receiver) const {
    return probabilities_[cell_at(receiver) * groups_ + group];
  }

 private:
  static constexpr int kResolution = 8;  // cells per axis
  static constexpr size_t kCells = size_t{kResolution} * kResolution * kResolution;

  void place_grid(std::span<const Vec3> receivers);
  size_t cell_at(const Vec3& position) const;

  size_t groups_;
  Vec3 origin_{0}, cells_per_unit_{0};
  std::vector<float> probabilities_;  // of cell i and group g at i * groups_ + g
};

}  // namespace etendue
