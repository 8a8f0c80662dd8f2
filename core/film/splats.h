// Contributions of light paths to arbitrary pixels, and their accumulation
//
// A light path does not select its pixel in advance. Each task fills a list of contributions. The lists are added in
// the order of the tasks, in parallel for different rows of the image. The sums therefore have the same bits for any
// number of threads, and no task waits for another.
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

// Selects the pixel to which an image point contributes. The filters of several pixels overlap at a point; one pixel is
// selected with a probability proportional to its filter value at the point. The expected value is the same as if the
// point contributed to all of these pixels. With the filters `box` and `centre`, a point contributes to its own pixel,
// since no light path hits the exact centre of a pixel.
class SplatFilter {
 public:
  SplatFilter(const Filter& filter, int width, int height)
      : filter_(&filter),
        width_(width),
        height_(height),
        radius_(filter.radius()),
        own_pixel_only_(filter.kind() == FilterKind::box || filter.kind() == FilterKind::centre) {}

  struct Choice {
    uint32_t pixel;
    float weight;  // the sum of the filters of all pixels at this point, approximately 1
  };
  // `raster` is in pixels from the upper left corner, `u` a uniform point of the unit square. Nothing if the selected
  // pixel is outside of the image.
  std::optional<Choice> choose(Vec2 raster, Vec2 u) const {
    if (!reaches(raster)) return {};
    const Cell x = choose(raster.x, u.x), y = choose(raster.y, u.y);
    if (x.index < 0 || y.index < 0 || x.index >= width_ || y.index >= height_) return {};
    return Choice{static_cast<uint32_t>(y.index * width_ + x.index), x.weight * y.weight};
  }

  // Whether a point can contribute to a pixel of the image.
  bool reaches(Vec2 raster) const {
    const float r = radius_;
    return raster.x > -r && raster.y > -r && raster.x < static_cast<float>(width_) + r &&
           raster.y < static_cast<float>(height_) + r;
  }

 private:
  // The column or the row that was selected.
  struct Cell {
    int index;
    float weight;
  };
  Cell choose(float x, float u) const {
    if (own_pixel_only_) return {static_cast<int>(std::floor(x)), 1};
    const float base = std::floor(x - 0.5f);
    const Filter::Sums sums = filter_->sums_around(x - 0.5f - base);
    const float target = u * sums[3];
    const int chosen = (target >= sums[0]) + (target >= sums[1]) + (target >= sums[2]);
    return {static_cast<int>(base) - 1 + chosen, sums[3]};
  }

  const Filter* filter_;
  int width_, height_;
  float radius_;
  bool own_pixel_only_;
};

// Adds the contributions to the rows [first, end) of an image of this width, list by list.
void add_rows(std::span<const Splats> lists, int width, int first, int end, std::span<Rgb> image);

}  // namespace etendue::film
