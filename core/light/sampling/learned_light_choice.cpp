#include "light/sampling/learned_light_choice.h"

#include <algorithm>
#include <cmath>

namespace etendue {
namespace {

// The grid leaves out this part of the receivers on each side of an axis: a few distant ones would make all cells large.
constexpr double kOutside = 0.02;
// The samples of the whole scene count as this number of samples of each cell.
constexpr double kPriorSamples = 4;
// This part of the mean light of all paths is added to the light of a path: relative errors of black pixels do not matter.
constexpr double kBlack = 0.05;
// The part of the choices that all groups share equally.
constexpr double kUniformShare = 0.1;

// By path, with the constant that is added.
std::vector<double> light_of_paths(const LightContributions& contributions) {
  std::vector<double> light;
  double sum = 0;
  for (size_t i = 0; i < contributions.receivers.size(); ++i) {
    const auto& receiver = contributions.receivers[i];
    if (receiver.path >= light.size()) light.resize(receiver.path + 1);
    double direct = double{receiver.others};
    for (const auto& group : contributions.of_receiver(i)) direct += double{group.mean};
    light[receiver.path] += direct;
    sum += direct;
  }
  for (double& l : light) l += kBlack * sum / static_cast<double>(light.size());
  return light;
}

}  // namespace

LearnedLightChoice::LearnedLightChoice(const LightContributions& contributions)
    : groups_(contributions.groups), squares_(kCells * groups_), by_bsdf_(kCells * groups_) {
  place_grid(contributions.receivers);
  const std::vector<double> light = light_of_paths(contributions);
  std::vector<double> weighted(kCells * groups_), counts(kCells);
  for (size_t i = 0; i < contributions.receivers.size(); ++i) {
    const auto& receiver = contributions.receivers[i];
    const double scale = light[receiver.path] > 0 ? 1 / (light[receiver.path] * light[receiver.path]) : 0;
    const size_t cell = cell_at(receiver.position);
    const auto groups = contributions.of_receiver(i);
    counts[cell] += 1;
    for (size_t g = 0; g < groups_; ++g) {
      const size_t at = cell * groups_ + g;
      weighted[at] += double{groups[g].weighted} * scale;
      squares_[at] += double{groups[g].square} * scale;
      by_bsdf_[at] += double{groups[g].by_bsdf} * scale;
    }
  }
  set_probabilities(weighted, counts);
}

// Mean squares are relative to their sum over the groups, in each cell and in the whole scene.
void LearnedLightChoice::set_probabilities(std::span<const double> weighted, std::span<const double> counts) {
  std::vector<double> all(groups_), shares(groups_);
  double total = 0;
  for (size_t i = 0; i < weighted.size(); ++i) all[i % groups_] += weighted[i], total += weighted[i];
  probabilities_.resize(kCells * groups_);
  for (size_t cell = 0; cell < kCells; ++cell) {
    const auto of_cell = weighted.subspan(cell * groups_, groups_);
    double in_cell = 0, sum = 0;
    for (const double w : of_cell) in_cell += w;
    const double scale = in_cell > 0 ? counts[cell] / in_cell : 0;
    for (size_t g = 0; g < groups_; ++g)
      sum += shares[g] = std::sqrt(of_cell[g] * scale + (total > 0 ? kPriorSamples * all[g] / total : 1));
    for (size_t g = 0; g < groups_; ++g)
      probabilities_[cell * groups_ + g] =
          static_cast<float>((1 - kUniformShare) * shares[g] / sum + kUniformShare / static_cast<double>(groups_));
  }
}

double LearnedLightChoice::gain(std::span<const float> usual) const {
  double before = 0, after = 0;
  for (size_t i = 0; i < squares_.size(); ++i) {
    if (squares_[i] == 0) continue;
    const double b = by_bsdf_[i] / squares_[i];
    before += squares_[i] / (double{usual[i % groups_]} + b);
    after += squares_[i] / (double{probabilities_[i]} + b);
  }
  return after > 0 ? before / after : 1;
}

void LearnedLightChoice::place_grid(std::span<const LightContributions::Receiver> receivers) {
  if (receivers.empty()) return;
  std::vector<float> coordinates(receivers.size());
  const auto low = static_cast<size_t>(kOutside * static_cast<double>(receivers.size() - 1));
  const size_t high = receivers.size() - 1 - low;
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(receivers, coordinates.begin(), [axis](const auto& r) { return r.position[axis]; });
    std::ranges::sort(coordinates);
    origin_[axis] = coordinates[low];
    const float size = coordinates[high] - coordinates[low];
    cells_per_unit_[axis] = size > 0 ? kResolution / size : 0;
  }
}

size_t LearnedLightChoice::cell_at(const Vec3& position) const {
  const auto place = [&](int axis) {
    const float x = (position[axis] - origin_[axis]) * cells_per_unit_[axis];
    return x > 0 ? static_cast<size_t>(std::min(x, kResolution - 0.5f)) : 0;
  };
  return (place(0) * kResolution + place(1)) * kResolution + place(2);
}

LearnedLightChoice::Group LearnedLightChoice::choose(const Vec3& receiver, float u) const {
  const float* p = &probabilities_[cell_at(receiver) * groups_];
  size_t group = 0;
  for (; group + 1 < groups_ && u >= p[group]; ++group) u -= p[group];
  return {group, p[group], std::clamp(u / p[group], 0.0f, kOneMinusEpsilon)};
}

}  // namespace etendue
