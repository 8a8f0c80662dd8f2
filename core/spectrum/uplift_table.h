// The table of spectra for RGB colours: coefficients of SigmoidSpectrum at the nodes of a grid (uplift.h).
//
// tools/uplift_table computes it while the program is built.
#pragma once
#include <cstddef>

namespace etendue::uplift {

// Nodes along the largest component and along the ratios of the others to it.
inline constexpr size_t kScales = 32, kRatios = 32;
// By the index of the largest component, its value, and the two ratios: c0, c1, c2 and padding.
inline constexpr size_t kTableSize = 3 * kScales * kRatios * kRatios * 4;
extern const float kTable[kTableSize];

constexpr size_t table_index(size_t largest, size_t scale, size_t y, size_t x) {
  return 4 * (((largest * kScales + scale) * kRatios + y) * kRatios + x);
}

// The value of the largest component at a node. The nodes are denser near 0 and 1, where the coefficients vary most.
constexpr double scale_at(size_t node) {
  const auto smooth = [](double x) { return x * x * (3 - 2 * x); };
  return smooth(smooth(static_cast<double>(node) / (kScales - 1)));
}

}  // namespace etendue::uplift
