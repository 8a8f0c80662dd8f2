// Filters of pictures that are products of one filter along rows and one along columns.
#pragma once
#include <cstddef>
#include <vector>

namespace etendue::metrics {

// One number a pixel, row by row.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;

  Plane(int w, int h) : width(w), height(h), values(static_cast<size_t>(w) * static_cast<size_t>(h)) {}
  float* row(int y) { return values.data() + static_cast<size_t>(y) * static_cast<size_t>(width); }
  const float* row(int y) const { return values.data() + static_cast<size_t>(y) * static_cast<size_t>(width); }
};

// An odd number of weights; the middle one is for the pixel itself.
struct Kernel {
  std::vector<float> taps;
  int radius() const { return static_cast<int>(taps.size() / 2); }
};

// out(x, y) = sum over i, j of across[i] down[j] in(x + i, y + j); the outermost pixels go on beyond the edge.
Plane filtered_rows(const Plane& in, const Kernel& across);
Plane filtered_columns(const Plane& in, const Kernel& down);
Plane filtered(const Plane& in, const Kernel& across, const Kernel& down);

}  // namespace etendue::metrics
