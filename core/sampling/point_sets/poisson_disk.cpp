#include "sampling/point_sets/poisson_disk.h"

#include <numbers>

#include "sampling/point_group.h"

namespace etendue {
namespace {

using Point = std::array<double, 2>;
using Points = PoissonDiskSampler::Points;

// A sequence of random numbers for the construction of a set.
class Sequence {
 public:
  double next() { return static_cast<double>(mix_bits(++state_) >> 11) * 0x1p-53; }
  Point next_point() {
    const double x = next();
    return {x, next()};
  }

 private:
  uint64_t state_ = 0;
};

double wrapped(double difference) { return difference - std::round(difference); }
double distance(const Point& p, const Point& q) { return std::hypot(wrapped(p[0] - q[0]), wrapped(p[1] - q[1])); }

double distance_to_set(const Point& p, const std::vector<Point>& set) {
  double least = 1;
  for (const Point& q : set) least = std::min(least, distance(p, q));
  return least;
}

// The distance at which disks of half of it, `count` in number, cover a share of the area.
double distance_for(int count, double coverage) { return std::sqrt(4 * coverage / (std::numbers::pi * count)); }

Points throw_darts(int count) {
  // Random sequential placement covers 0.547 of the area [Feder 1980].
  Points set{distance_for(count, 0.547), {}};
  Sequence random;
  for (int i = 0; i < 2000 * count; ++i) {
    const Point p = random.next_point();
    if (distance_to_set(p, set.points) >= set.distance) set.points.push_back(p);
  }
  return set;
}

Points grow_from_front(int count) {
  constexpr int kCandidates = 30;  // around a point before it leaves the front [Bridson 2007]
  // Candidates are uniform over the annulus between one and two distances. The share of the area is measured.
  Points set{distance_for(count, 0.53), {}};
  Sequence random;
  set.points.push_back(random.next_point());
  std::vector<size_t> front{0};
  while (!front.empty()) {
    const auto chosen = static_cast<size_t>(random.next() * static_cast<double>(front.size()));
    bool found = false;
    for (int i = 0; i < kCandidates && !found; ++i) {
      const double radius = set.distance * std::sqrt(1 + 3 * random.next()),
                   angle = 2 * std::numbers::pi * random.next();
      Point p = set.points[front[chosen]];
      p[0] += radius * std::cos(angle);
      p[1] += radius * std::sin(angle);
      for (double& x : p) x -= std::floor(x);
      found = distance_to_set(p, set.points) >= set.distance;
      if (found) set.points.push_back(p);
    }
    if (found) {
      front.push_back(set.points.size() - 1);
    } else {
      front[chosen] = front.back();
      front.pop_back();
    }
  }
  return set;
}

Points best_candidates(int count) {
  Points set{1, {}};
  Sequence random;
  while (static_cast<int>(set.points.size()) < count) {
    const size_t candidates = 10 * set.points.size() + 1;
    Point best{};
    double largest = -1;
    for (size_t i = 0; i < candidates; ++i) {
      const Point p = random.next_point();
      const double d = distance_to_set(p, set.points);
      if (d <= largest) continue;
      largest = d;
      best = p;
    }
    set.points.push_back(best);
    set.distance = std::min(set.distance, largest);
  }
  return set;
}

Points generate(PoissonDiskAlgorithm algorithm, int count) {
  switch (algorithm) {
    case PoissonDiskAlgorithm::bridson:
      return grow_from_front(count);
    case PoissonDiskAlgorithm::best_candidate:
      return best_candidates(count);
    case PoissonDiskAlgorithm::darts:
      break;
  }
  return throw_darts(count);
}

using SetsOfSizes = std::array<Points, Options<PoissonDiskSize>::kOptions.size()>;
SetsOfSizes generate_all(PoissonDiskAlgorithm algorithm) {
  return {generate(algorithm, 16), generate(algorithm, 64), generate(algorithm, 256)};
}

}  // namespace

const PoissonDiskSampler::Points& PoissonDiskSampler::points(PoissonDiskSize size, PoissonDiskAlgorithm algorithm) {
  const auto s = static_cast<size_t>(size);
  switch (algorithm) {
    case PoissonDiskAlgorithm::bridson: {
      static const SetsOfSizes sets = generate_all(PoissonDiskAlgorithm::bridson);
      return sets[s];
    }
    case PoissonDiskAlgorithm::best_candidate: {
      static const SetsOfSizes sets = generate_all(PoissonDiskAlgorithm::best_candidate);
      return sets[s];
    }
    case PoissonDiskAlgorithm::darts:
      break;
  }
  static const SetsOfSizes sets = generate_all(PoissonDiskAlgorithm::darts);
  return sets[s];
}

void PoissonDiskSampler::block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const {
  const Points& set = points(size, algorithm);
  const auto count = static_cast<uint32_t>(set.points.size());
  fill_from_group(group_member(pixel_seed, sample, block, count), count, out, [&](uint32_t i, uint32_t seed) {
    return std::array{rotated(set.points[i][0], seed), rotated(set.points[i][1], ~seed)};
  });
}

}  // namespace etendue
