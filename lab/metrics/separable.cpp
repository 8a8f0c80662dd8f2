#include "metrics/separable.h"

#include <algorithm>

namespace etendue::metrics {
namespace {

void add_scaled(float* out, const float* in, float weight, int count) {
  for (int x = 0; x < count; ++x) out[x] += weight * in[x];
}

}  // namespace

Plane convolve_rows(const Plane& in, const Kernel& across) {
  Plane out(in.width, in.height);
  const int r = across.radius();
  // The row padded with its end values, so that the inner loop needs no bounds checks.
  std::vector<float> padded(static_cast<size_t>(in.width + 2 * r));
  for (int y = 0; y < in.height; ++y) {
    const float* row = in.row(y);
    std::fill_n(padded.begin(), r, row[0]);
    std::copy_n(row, in.width, padded.begin() + r);
    std::fill_n(padded.begin() + r + in.width, r, row[in.width - 1]);
    for (size_t i = 0; i < across.taps.size(); ++i) add_scaled(out.row(y), padded.data() + i, across.taps[i], in.width);
  }
  return out;
}

Plane convolve_columns(const Plane& in, const Kernel& down) {
  Plane out(in.width, in.height);
  const int r = down.radius();
  for (int y = 0; y < in.height; ++y)
    for (int j = -r; j <= r; ++j)
      add_scaled(out.row(y), in.row(std::clamp(y + j, 0, in.height - 1)), down.taps[static_cast<size_t>(j + r)],
                 in.width);
  return out;
}

Plane convolve(const Plane& in, const Kernel& across, const Kernel& down) {
  return convolve_columns(convolve_rows(in, across), down);
}

}  // namespace etendue::metrics
