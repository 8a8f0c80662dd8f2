#include "sampling/point_sets/poisson_disk.h"

#include "sampling/point_group.h"

namespace etendue {
namespace {

double wrapped(double difference) { return difference - std::round(difference); }

PoissonDiskSampler::Points throw_darts(int count) {
  // Random sequential placement covers 0.547 of the area with disks of half of the distance [Feder 1980].
  constexpr double kCoverage = 0.547, kPi = 3.14159265358979324;
  PoissonDiskSampler::Points set{std::sqrt(4 * kCoverage / (kPi * count)), {}};
  const auto is_free = [&](const std::array<double, 2>& p) {
    return std::ranges::all_of(set.points, [&](const auto& q) {
      return std::hypot(wrapped(p[0] - q[0]), wrapped(p[1] - q[1])) >= set.distance;
    });
  };
  const uint64_t darts = 2000 * static_cast<uint64_t>(count);
  for (uint64_t i = 0; i < darts; ++i) {
    const uint64_t bits = mix_bits(i + 1);
    const std::array p{static_cast<double>(bits >> 32) * 0x1p-32, static_cast<double>(bits & 0xffffffffU) * 0x1p-32};
    if (is_free(p)) set.points.push_back(p);
  }
  return set;
}

}  // namespace

const PoissonDiskSampler::Points& PoissonDiskSampler::points(PoissonDiskSize size) {
  static const std::array sets{throw_darts(16), throw_darts(64), throw_darts(256)};
  return sets[static_cast<size_t>(size)];
}

void PoissonDiskSampler::block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const {
  const Points& set = points(size);
  const auto count = static_cast<uint32_t>(set.points.size());
  fill_from_group(group_member(pixel_seed, sample, block, count), count, out, [&](uint32_t i, uint32_t seed) {
    return std::array{rotated(set.points[i][0], seed), rotated(set.points[i][1], ~seed)};
  });
}

}  // namespace etendue
