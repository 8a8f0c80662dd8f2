// What is found for pixels anywhere in a picture, and adding it up.
//
// A light path does not choose its pixel. Tasks that run side by side each fill a list; lists are added up in the order
// of the tasks, band by band of the picture, so that the sums have the same bits whatever the number of threads, and no
// task ever waits for another.
#pragma once
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "film/filter.h"
#include "spectrum/rgb.h"

namespace etendue::film {

struct Splat {
  uint32_t pixel;  // row by row from the top
  Rgb radiance;
};

using Splats = std::vector<Splat>;

// Which pixel a point of the picture goes to. Filters reach over several pixels; each point belongs to one of them,
// chosen with the probability of its filter's value there, as samples under a filter belong to one pixel each. Means
// over many points are the same as of points that belong to all. No light path falls on the centre of a pixel: where
// only centres count, the pixel as a whole does.
class SplatFilter {
 public:
  SplatFilter(const Filter& filter, int width, int height)
      : filter_(&filter),
        width_(width),
        height_(height),
        radius_(filter.radius()),
        whole_(filter.kind() == FilterKind::box || filter.kind() == FilterKind::centre) {}

  struct Choice {
    uint32_t pixel;
    float weight;  // the sum of all filters at this point: about one
  };
  // `raster` is in pixels, (0, 0) the upper left corner; `u` in the unit square. Nothing if the pixel lies outside.
  std::optional<Choice> choose(Vec2 raster, Vec2 u) const {
    if (!reaches(raster)) return {};
    const Column x = choose(raster.x, u.x), y = choose(raster.y, u.y);
    if (x.index < 0 || y.index < 0 || x.index >= width_ || y.index >= height_) return {};
    return Choice{static_cast<uint32_t>(y.index * width_ + x.index), x.weight * y.weight};
  }

  // The part of the plane whose points may belong to a pixel.
  bool reaches(Vec2 raster) const {
    const float r = radius_;
    return raster.x > -r && raster.y > -r && raster.x < static_cast<float>(width_) + r &&
           raster.y < static_cast<float>(height_) + r;
  }

 private:
  struct Column {
    int index;
    float weight;
  };
  Column choose(float x, float u) const {
    // Without values in between: each point has its own pixel.
    if (whole_) return {static_cast<int>(std::floor(x)), 1};
    const float base = std::floor(x - 0.5f);
    const Filter::Sums sums = filter_->sums_around(x - 0.5f - base);
    const float at = u * sums[3];
    const int chosen = (at >= sums[0]) + (at >= sums[1]) + (at >= sums[2]);
    return {static_cast<int>(base) - 1 + chosen, sums[3]};
  }

  const Filter* filter_;
  int width_, height_;
  float radius_;
  bool whole_;
};

// Adds what lists hold for the pixels of rows [first, end) of a picture of this width, list by list.
void add_rows(std::span<const Splats> lists, int width, int first, int end, std::span<Rgb> picture);

}  // namespace etendue::film
