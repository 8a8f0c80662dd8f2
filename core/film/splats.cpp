#include "film/splats.h"

#include <array>
#include <cmath>

namespace etendue::film {

SplatFilter::Column SplatFilter::choose(float x, float u) const {
  constexpr size_t kMost = 8;
  const float radius = filter_->radius();
  const int first = static_cast<int>(std::floor(x - radius + 0.5f)),
            last = static_cast<int>(std::floor(x + radius - 0.5f));
  std::array<float, kMost> sums;
  const auto count = std::min(kMost, static_cast<size_t>(last - first + 1));
  float sum = 0;
  for (size_t i = 0; i < count; ++i) {
    const float centre = static_cast<float>(first + static_cast<int>(i)) + 0.5f;
    sum += filter_->quick_value(x - centre);
    sums[i] = sum;
  }
  size_t chosen = 0;
  while (chosen + 1 < count && !(u * sum < sums[chosen])) ++chosen;
  return {first + static_cast<int>(chosen), sum};
}

std::optional<SplatFilter::Choice> SplatFilter::choose(Vec2 raster, Vec2 u) const {
  if (!reaches(raster)) return {};
  const Column x = choose(raster.x, u.x), y = choose(raster.y, u.y);
  if (x.index < 0 || y.index < 0 || x.index >= width_ || y.index >= height_) return {};
  return Choice{static_cast<uint32_t>(y.index * width_ + x.index), x.weight * y.weight};
}

void add_rows(std::span<const Splats> lists, int width, int first, int end, std::span<Rgb> picture) {
  const auto begin = static_cast<uint32_t>(first * width);
  const uint32_t count = static_cast<uint32_t>(end * width) - begin;
  for (const Splats& list : lists)
    for (const Splat& splat : list)
      if (splat.pixel - begin < count) picture[splat.pixel] += splat.radiance;
}

}  // namespace etendue::film
