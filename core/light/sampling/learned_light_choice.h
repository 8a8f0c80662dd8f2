// Probabilities of groups of lights for the regions of a scene, learned from samples.
//
// Powers and the bounds of the light tree do not know what is visible: the sun has most of the power, but a room with a
// small window receives nearly all of its light from the lights inside. Samples at the vertices of a few paths show what
// the groups contribute. With one light sample per receiver, group g chosen with probability p_g and contributing c_g, the
// variance is smallest if p_g is proportional to the root of the mean of c_g^2. Here c_g is the contribution to the pixel,
// relative to all light of the path, so that dark pixels count as much as bright ones.
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

// Receivers of light at the vertices of paths, and what each group contributes to the pixels by way of them.
struct LightContributions {
  // Means over the samples c; finite. A sample has the density p_l in its group, and BSDF samples have p_b there.
  struct Moments {
    float mean = 0;      // of c
    float square = 0;    // of c^2
    float weighted = 0;  // of (w c)^2, with the MIS weight w if all groups are equally likely
    float by_bsdf = 0;   // of c^2 p_b / p_l
  };

  explicit LightContributions(size_t group_count) : groups(group_count) {}
  // Returns the index of the receiver.
  size_t add_receiver(const Vec3& position, uint32_t path) {
    receivers.push_back({position, path, 0});
    moments.resize(receivers.size() * groups);
    return receivers.size() - 1;
  }
  std::span<const Moments> of_receiver(size_t i) const { return std::span(moments).subspan(i * groups, groups); }

  struct Receiver {
    Vec3 position;
    uint32_t path;
    float others;  // direct light that light samples leave to BSDF samples
  };

  size_t groups;
  std::vector<Receiver> receivers;
  std::vector<Moments> moments;  // of receiver i and group g at i * groups + g
};

class LearnedLightChoice {
 public:
  struct Group {
    size_t index;
    float probability;
    float rest;  // a uniform random number in [0, 1), independent of the choice
  };

  explicit LearnedLightChoice(const LightContributions& contributions);

  // By which factor the mean square falls if groups have the learned probabilities in place of these, which are the same
  // everywhere. 1 if nothing was found. With the balance heuristic, one light sample by the probability q and one BSDF sample
  // have the mean square E[c^2 p_l / (q p_l + p_b)]; it is approximated by E[c^2] / (q + b), b = E[c^2 p_b / p_l] / E[c^2].
  double gain(std::span<const float> usual) const;

  size_t group_count() const { return groups_; }
  Group choose(const Vec3& receiver, float u) const;
  float probability(size_t group, const Vec3& receiver) const {
    return probabilities_[cell_at(receiver) * groups_ + group];
  }

 private:
  static constexpr int kResolution = 8;  // cells per axis
  static constexpr size_t kCells = size_t{kResolution} * kResolution * kResolution;

  void place_grid(std::span<const LightContributions::Receiver> receivers);
  void set_probabilities(std::span<const double> weighted, std::span<const double> counts);
  size_t cell_at(const Vec3& position) const;

  size_t groups_;
  Vec3 origin_{0}, cells_per_unit_{0};
  // Of cell i and group g at i * groups_ + g.
  std::vector<float> probabilities_;
  std::vector<double> squares_, by_bsdf_;  // sums of these moments
};

}  // namespace etendue
