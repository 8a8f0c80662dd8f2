// What is found for pixels anywhere in a picture, and adding it up.
//
// A light path does not choose its pixel. Tasks that run side by side each fill a list; lists are added up in the order
// of the tasks, band by band of the picture, so that the sums have the same bits whatever the number of threads, and no
// task ever waits for another.
#pragma once
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
// over many points are the same as of points that belong to all.
class SplatFilter {
 public:
  SplatFilter(const Filter& filter, int width, int height) : filter_(&filter), width_(width), height_(height) {}

  struct Choice {
    uint32_t pixel;
    float weight;  // the sum of all filters at this point: about one
  };
  // `raster` is in pixels, (0, 0) the upper left corner; `u` in the unit square. Nothing if the pixel lies outside.
  std::optional<Choice> choose(Vec2 raster, Vec2 u) const;

  // The part of the plane whose points may belong to a pixel.
  bool reaches(Vec2 raster) const {
    const float r = filter_->radius();
    return raster.x > -r && raster.y > -r && raster.x < static_cast<float>(width_) + r &&
           raster.y < static_cast<float>(height_) + r;
  }

 private:
  struct Column {
    int index;
    float weight;
  };
  Column choose(float x, float u) const;

  const Filter* filter_;
  int width_, height_;
};

// Adds what lists hold for the pixels of rows [first, end) of a picture of this width, list by list.
void add_rows(std::span<const Splats> lists, int width, int first, int end, std::span<Rgb> picture);

}  // namespace etendue::film
