#include "stress/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/hash.h"
#include "sampling/sampler.h"

namespace etendue::stress {
namespace {

// First and second moments of pairs of values.
struct Moments {
  double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  void add(double a, double b) {
    n += 1;
    x += a;
    y += b;
    xx += a * a;
    yy += b * b;
    xy += a * b;
  }
  double correlation() const {
    const double vx = xx / n - x / n * (x / n), vy = yy / n - y / n * (y / n);
    return vx > 0 && vy > 0 ? (xy / n - x / n * (y / n)) / std::sqrt(vx * vy) : 0;
  }
};

}  // namespace

double noise_correlation(const film::Film& a, const film::Film& b, int shift) {
  Moments moments;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x + shift < a.width(); ++x) moments.add(average(a.mean(x, y)), average(b.mean(x + shift, y)));
  return moments.correlation();
}

double variance_of_mean(const film::Film& a, const film::Film& b) {
  Moments moments;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) moments.add((average(a.mean(x, y)) + average(b.mean(x, y))) / 2, 0);
  return moments.xx / moments.n - moments.x / moments.n * (moments.x / moments.n);
}

double clumped_pixel_fraction(const std::string& name, uint32_t dimension) {
  constexpr uint32_t kPixels = 4000, kSamples = 64;
  constexpr size_t kSide = 8;
  const auto sampler = make_sampler(name);
  sampler->prepare(0, kSamples);
  uint32_t clumped = 0;
  for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    std::array<bool, kSide * kSide> hit{};
    for (uint32_t s = 0; s < kSamples; ++s) {
      SampleBlock block;
      sampler->block(mix_bits(pixel + 1), s, dimension / kBlockSize, block);
      const size_t k = dimension % kBlockSize;
      hit[static_cast<size_t>(block[k] * kSide) * kSide + static_cast<size_t>(block[k + 1] * kSide)] = true;
    }
    clumped += static_cast<size_t>(std::ranges::count(hit, true)) <= hit.size() / 2;
  }
  return static_cast<double>(clumped) / kPixels;
}

}  // namespace etendue::stress
