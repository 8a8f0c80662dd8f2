#include "light/sampling/light_selector.h"

#include "light/sampling/learned_light_choice.h"

namespace etendue {
namespace {

// The tree pays from this number of lights (docs/results/lights.md), if they are apart: their area is less than this
// part of the squared radius around them. The triangles of one large light are all equally near; choosing among them by
// power keeps the strata of the random numbers intact.
constexpr size_t kMinLightsForTree = 8;
constexpr float kMaxAreaOverRadius2 = 0.5f;

// The share of lights without a position and the share of the others are at least this, whatever their powers.
constexpr float kMinShare = 0.25f;

// The part of the choices that is by power when the tree is used.
constexpr float kPowerShare = 1.0f / 64;

}  // namespace

LightSelector::LightSelector(std::span<const SelectableLight> lights, std::shared_ptr<const LightTree> tree)
    : tree_(std::move(tree)) {
  std::vector<float> powers;
  powers.reserve(lights.size());
  bool any = false;
  for (const SelectableLight& light : lights) {
    powers.push_back(light.power);
    any = any || light.power > 0;
  }
  if (!any) return;
  by_power_ = AliasTable(powers);
  find_sources(lights);
  build_tree(lights);
  find_groups(lights);
}

void LightSelector::find_sources(std::span<const SelectableLight> lights) {
  cumulative_.resize(lights.size());
  for (uint32_t first = 0, end = 0; first < lights.size(); first = end) {
    Source source{first, 0, 0};
    while (end < lights.size() && lights[end].source == lights[first].source) {
      source.probability += by_power_.probability(end);
      cumulative_[end] = source.probability;
      ++end;
    }
    source.count = end - first;
    if (source.probability > 0) sources_.push_back(source);
  }
}

void LightSelector::build_tree(std::span<const SelectableLight> lights) {
  std::vector<LightBounds> bounds(tree_ ? 0 : lights.size());
  std::vector<float> infinite_powers;
  float all_power = 0;
  float area = 0;
  Bounds around;
  for (uint32_t i = 0; i < lights.size(); ++i) {
    const SelectableLight& light = lights[i];
    all_power += light.power;
    if (light.is_infinite) {
      infinite_.push_back(i);
      infinite_powers.push_back(light.power);
    } else if (light.power > 0) {
      if (!tree_) bounds[i] = light.bounds;
      around.extend(light.bounds.box);
      area += light.area;
    }
  }
  if (!tree_) tree_ = std::make_shared<const LightTree>(bounds);
  tree_pays_ =
      lights.size() - infinite_.size() >= kMinLightsForTree && area < kMaxAreaOverRadius2 * sqr(around.radius());
  float infinite_power = 0;
  for (const float power : infinite_powers) infinite_power += power;
  if (!(infinite_power > 0)) return;
  infinite_by_power_ = AliasTable(infinite_powers);
  infinite_share_ = tree_->empty() ? 1 : std::clamp(infinite_power / all_power, kMinShare, 1 - kMinShare);
}

void LightSelector::find_groups(std::span<const SelectableLight> lights) {
  group_of_.resize(lights.size());
  for (uint32_t s = 0; s < sources_.size() && groups_.size() <= kMostGroups; ++s) {
    const Source& source = sources_[s];
    const bool in_tree = tree_pays_ && !lights[source.first].is_infinite;
    const auto same = in_tree ? std::ranges::find(groups_, kTreeGroup) : groups_.end();
    const auto group = static_cast<uint8_t>(same - groups_.begin());
    if (same == groups_.end()) groups_.push_back(in_tree ? kTreeGroup : s);
    std::fill_n(group_of_.begin() + source.first, source.count, group);
  }
  if (groups_.size() < 2 || groups_.size() > kMostGroups) groups_.clear(), group_of_.clear();
}

float LightSelector::usual_probability_of_group(size_t group, LightStrategy strategy) const {
  const uint32_t source = groups_[group];
  if (!uses_tree(strategy)) return sources_[source].probability;
  // All groups but the tree are single lights without a position.
  if (source != kTreeGroup) return probability_by_tree(sources_[source].first, Vec3(0));
  float others = 0;
  for (size_t g = 0; g < groups_.size(); ++g)
    if (g != group) others += usual_probability_of_group(g, strategy);
  return 1 - others;
}

LightSelector::Choice LightSelector::choose_in_group(size_t group, const LightReceiver& from, float u) const {
  return groups_[group] == kTreeGroup ? tree_->choose(from, u) : choose_in_source(groups_[group], u);
}

LightSelector::Choice LightSelector::choose_by_group(const LearnedLightChoice& learned, const LightReceiver& from,
                                                     float u) const {
  if (u < kPowerShare) {
    const Choice choice = by_power_.sample(u / kPowerShare);
    return {choice.index, choice.probability > 0 ? probability_by_group(learned, choice.index, from) : 0};
  }
  const auto group = learned.choose(from.position, std::min((u - kPowerShare) / (1 - kPowerShare), kOneMinusEpsilon));
  Choice choice = choose_in_group(group.index, from, group.rest);
  if (choice.probability > 0)
    choice.probability =
        (1 - kPowerShare) * group.probability * choice.probability + kPowerShare * by_power_.probability(choice.index);
  return choice;
}

float LightSelector::probability_by_group(const LearnedLightChoice& learned, uint32_t light,
                                          const LightReceiver& from) const {
  const float power = by_power_.probability(light);
  if (!(power > 0)) return 0;
  const size_t group = group_of_[light];
  const uint32_t source = groups_[group];
  const float within = source == kTreeGroup ? tree_->probability(light, from) : power / sources_[source].probability;
  return (1 - kPowerShare) * learned.probability(group, from.position) * within + kPowerShare * power;
}

LightSelector::Choice LightSelector::choose_by_tree(const LightReceiver& from, float u) const {
  if (u < kPowerShare) {
    const Choice choice = by_power_.sample(u / kPowerShare);
    return {choice.index, choice.probability > 0 ? probability_by_tree(choice.index, from) : 0};
  }
  u = std::min((u - kPowerShare) / (1 - kPowerShare), kOneMinusEpsilon);
  const auto with_power_share = [&](uint32_t light, float probability) {
    return Choice{light, (1 - kPowerShare) * probability + kPowerShare * by_power_.probability(light)};
  };
  if (u < infinite_share_) {
    const Choice choice = infinite_by_power_.sample(u / infinite_share_);
    return with_power_share(infinite_[choice.index], choice.probability * infinite_share_);
  }
  const float tree_share = 1 - infinite_share_;
  const Choice choice = tree_->choose(from, std::min((u - infinite_share_) / tree_share, kOneMinusEpsilon));
  return choice.probability > 0 ? with_power_share(choice.index, choice.probability * tree_share) : choice;
}

LightSelector::Choice LightSelector::choose_in_source(size_t number, float u) const {
  const Source& source = sources_[number];
  if (source.count == 1) return {source.first, 1};
  const auto begin = cumulative_.begin() + source.first;
  const auto last = begin + (source.count - 1);
  const auto index = static_cast<uint32_t>(std::upper_bound(begin, last, u * source.probability) - cumulative_.begin());
  return {index, by_power_.probability(index) / source.probability};
}

const LightSelector::Source& LightSelector::source_of(uint32_t light) const {
  const auto after = std::upper_bound(sources_.begin() + 1, sources_.end(), light,
                                      [](uint32_t l, const Source& source) { return l < source.first; });
  return *(after - 1);
}

float LightSelector::probability(uint32_t light, const LightReceiver& from, LightStrategy strategy) const {
  if (uses_tree(strategy)) return probability_by_tree(light, from);
  const float p = by_power_.probability(light);
  return strategy == LightStrategy::every && p > 0 ? p / source_of(light).probability : p;
}

float LightSelector::probability_by_tree(uint32_t light, const LightReceiver& from) const {
  const auto found = std::lower_bound(infinite_.begin(), infinite_.end(), light);
  const bool is_infinite = found != infinite_.end() && *found == light;
  const float p = is_infinite
                      ? infinite_share_ * probability_of_infinite(static_cast<size_t>(found - infinite_.begin()))
                      : (1 - infinite_share_) * tree_->probability(light, from);
  return (1 - kPowerShare) * p + kPowerShare * by_power_.probability(light);
}

float LightSelector::probability_of_infinite(size_t index) const {
  return infinite_by_power_.empty() ? 0 : infinite_by_power_.probability(static_cast<uint32_t>(index));
}

}  // namespace etendue
