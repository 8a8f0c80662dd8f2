// Choosing a light: by power, by source, or by the light tree.
//
// Powers are an alias table: constant cost, the same probability for every receiver. The light tree (light_tree.h)
// chooses among lights with a position by their contribution bound at the receiver. Lights without a position
// (directional, ambient, environment) share a fixed part of the choices by power. A small part of all choices is by
// power, since the bound ignores occlusion: a strong light behind a wall would otherwise suppress the lights on this
// side. If probabilities of groups of lights have been learned (learned_light_choice.h), a group is chosen first.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "light/sampling/light_sample.h"
#include "light/sampling/light_tree.h"

namespace etendue {

// What the selector needs of one light.
struct SelectableLight {
  float power = 0;      // luminance of the flux into the scene, lm
  float area = 0;       // m^2; 0 of a light without extent
  uint32_t source = 0;  // neighbours with the same number are one source
  bool is_infinite = false;
  LightBounds bounds;  // unless infinite or without power
};

class LightSelector {
 public:
  using Choice = AliasTable::Choice;

  LightSelector() = default;
  explicit LightSelector(std::span<const SelectableLight> lights) : LightSelector(lights, nullptr) {}
  // The same with other powers of lights without a position. They are not in the tree, which is shared.
  LightSelector with_infinite_powers(std::span<const SelectableLight> lights) const { return {lights, tree_}; }

  // No light has any power.
  bool empty() const { return by_power_.empty(); }
  size_t size() const { return by_power_.size(); }

  // Whether the strategy chooses by the tree in this scene.
  bool uses_tree(LightStrategy strategy) const {
    const bool decides = strategy == LightStrategy::automatic || strategy == LightStrategy::emission_auto;
    return strategy == LightStrategy::tree || (decides && tree_pays_);
  }
  // A light with its probability, which is 0 if no light was found.
  Choice choose_by_power(float u) const { return by_power_.sample(u); }
  Choice choose_by_tree(const LightReceiver& from, float u) const;

  // Sources are lights as a user counts them: the emissive triangles of an instance, a light without extent, the
  // environment. Sources without power do not count.
  size_t source_count() const { return sources_.size(); }
  Choice choose_in_source(size_t source, float u) const;

  // Groups have learned probabilities: the lights of the tree together if it pays, otherwise each source; lights without a
  // position by themselves. None if there would be a single one, or more than kMostGroups.
  size_t group_count() const { return groups_.size(); }
  // Without learned probabilities, averaged over receivers.
  float usual_probability_of_group(size_t group, LightStrategy strategy) const;
  // The probability is that within the group.
  Choice choose_in_group(size_t group, const LightReceiver& from, float u) const;
  Choice choose_by_group(const LearnedLightChoice& learned, const LightReceiver& from, float u) const;
  float probability_by_group(const LearnedLightChoice& learned, uint32_t light, const LightReceiver& from) const;

  // The probability of a light from a receiver; of LightStrategy::every within its source.
  float probability(uint32_t light, const LightReceiver& from, LightStrategy strategy) const;
  float probability_by_power(uint32_t light) const { return by_power_.probability(light); }

 private:
  static constexpr uint32_t kTreeGroup = 0xffffffffU;
  static constexpr size_t kMostGroups = 16;

  struct Source {
    uint32_t first, count;
    float probability;  // of choosing one of its lights by power
  };

  void find_sources(std::span<const SelectableLight> lights);
  LightSelector(std::span<const SelectableLight> lights, std::shared_ptr<const LightTree> tree);
  void build_tree(std::span<const SelectableLight> lights);
  void find_groups(std::span<const SelectableLight> lights);
  const Source& source_of(uint32_t light) const;
  float probability_by_tree(uint32_t light, const LightReceiver& from) const;
  float probability_of_infinite(size_t index) const;

  AliasTable by_power_;
  std::vector<Source> sources_;
  std::vector<float> cumulative_;  // probability of a light and of those of its source before it

  std::shared_ptr<const LightTree> tree_;  // null if no light has any power
  std::vector<uint32_t> infinite_;         // numbers of the lights without a position, ascending
  AliasTable infinite_by_power_;
  float infinite_share_ = 0;
  bool tree_pays_ = false;

  std::vector<uint32_t> groups_;   // numbers of sources, or kTreeGroup
  std::vector<uint8_t> group_of_;  // of each light; empty without groups
};

}  // namespace etendue
