// Separable image filters: the product of a kernel along rows and a kernel along columns.
#pragma once
#include <cstddef>
#include <vector>

namespace etendue::metrics {

// A single-channel image, row by row.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;

  Plane(int w, int h) : width(w), height(h), values(static_cast<size_t>(w) * static_cast<size_t>(h)) {}
  float* row(int y) { return values.data() + static_cast<size_t>(y) * static_cast<size_t>(width); }
  const float* row(int y) const { return values.data() + static_cast<size_t>(y) * static_cast<size_t>(width); }
};

// An odd number of weights, centred on the pixel.
struct Kernel {
  std::vector<float> taps;
  int radius() const { return static_cast<int>(taps.size() / 2); }
};

// out(x, y) = sum over i, j of across[i] down[j] in(x + i, y + j). Pixels outside the image repeat the nearest edge
// pixel.
Plane convolve_rows(const Plane& in, const Kernel& across);
Plane convolve_columns(const Plane& in, const Kernel& down);
Plane convolve(const Plane& in, const Kernel& across, const Kernel& down);

}  // namespace etendue::metrics
