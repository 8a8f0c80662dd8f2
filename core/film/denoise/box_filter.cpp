#include "film/denoise/box_filter.h"

#include <algorithm>
#include <cstddef>

namespace etendue::film {
namespace {

// The mean of the values around the i-th of `length`, which are `step` apart.
float mean_around(const float* values, size_t step, int i, int length, int radius) {
  const int first = std::max(0, i - radius);
  const int last = std::min(length - 1, i + radius);
  double sum = 0;
  for (int k = first; k <= last; ++k) sum += double{values[static_cast<size_t>(k) * step]};
  return static_cast<float>(sum / (last - first + 1));
}

}  // namespace

std::vector<float> box_filtered(const std::vector<float>& values, int width, int height, int radius) {
  std::vector<float> rows(values.size());
  std::vector<float> result(values.size());
  const auto stride = static_cast<size_t>(width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      rows[static_cast<size_t>(y) * stride + static_cast<size_t>(x)] =
          mean_around(values.data() + static_cast<size_t>(y) * stride, 1, x, width, radius);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      result[static_cast<size_t>(y) * stride + static_cast<size_t>(x)] =
          mean_around(rows.data() + x, stride, y, height, radius);
  return result;
}

}  // namespace etendue::film
