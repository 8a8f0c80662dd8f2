#include "light/sampling/learned_light_choice.h"

#include <algorithm>
#include <cmath>

namespace etendue {
namespace {

// The grid leaves out this part of the receivers on each side of an axis: a few distant ones would make all cells large.
constexpr double kOutside = 0.02;
// The samples of the whole scene count as this number of samples of each cell.
constexpr double kPriorSamples = 4;
// Indirect light is assumed to be this part of the mean direct light of a cell. It hides the noise of receivers in shadow.
constexpr double kIndirectLight = 0.25;
// The part of the choices that all groups share equally.
constexpr double kUniformShare = 0.1;

double direct_light(const LightContributions& contributions, size_t receiver) {
  double light = double{contributions.others[receiver]};
  for (const auto& group : contributions.of_receiver(receiver)) light += double{group.mean};
  return light;
}

}  // namespace

LearnedLightChoice::LearnedLightChoice(const LightContributions& contributions) : groups_(contributions.groups) {
  const std::span<const Vec3> receivers = contributions.receivers;
  place_grid(receivers);
  std::vector<double> light(kCells), counts(kCells), squares(kCells * groups_), all(groups_);
  double lit = 0;
  for (size_t i = 0; i < receivers.size(); ++i) {
    light[cell_at(receivers[i])] += direct_light(contributions, i);
    counts[cell_at(receivers[i])] += 1;
  }
  for (size_t i = 0; i < receivers.size(); ++i) {
    const size_t cell = cell_at(receivers[i]);
    const double total = direct_light(contributions, i) + kIndirectLight * light[cell] / counts[cell];
    if (!(total > 0)) continue;
    lit += 1;
    const auto groups = contributions.of_receiver(i);
    for (size_t g = 0; g < groups_; ++g) {
      const double square = double{groups[g].square} / (total * total);
      squares[cell * groups_ + g] += square;
      all[g] += square;
    }
  }
  probabilities_.resize(kCells * groups_);
  std::vector<double> weights(groups_);
  for (size_t cell = 0; cell < kCells; ++cell) {
    double sum = 0;
    for (size_t g = 0; g < groups_; ++g) {
      const double prior = lit > 0 ? kPriorSamples * all[g] / lit : 1;
      sum += weights[g] = std::sqrt((squares[cell * groups_ + g] + prior) / (counts[cell] + kPriorSamples));
    }
    for (size_t g = 0; g < groups_; ++g)
      probabilities_[cell * groups_ + g] =
          static_cast<float>((1 - kUniformShare) * weights[g] / sum + kUniformShare / static_cast<double>(groups_));
  }
}

void LearnedLightChoice::place_grid(std::span<const Vec3> receivers) {
  if (receivers.empty()) return;
  std::vector<float> coordinates(receivers.size());
  const auto low = static_cast<size_t>(kOutside * static_cast<double>(receivers.size() - 1));
  const size_t high = receivers.size() - 1 - low;
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(receivers, coordinates.begin(), [axis](const Vec3& p) { return p[axis]; });
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
