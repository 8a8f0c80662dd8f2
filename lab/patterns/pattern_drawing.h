// Drawings of point sets and their spectra.
#pragma once
#include <string>

#include "metrics/drawing.h"
#include "patterns/periodogram.h"
#include "patterns/point_set.h"

namespace etendue::patterns {

struct PatternDrawingOptions {
  int size = 420;                     // of each part, pixels
  std::array<int, 2> cells = {1, 1};  // columns and rows of a grid over the points
  int extent = 32;                    // highest frequency of the spectrum
};

// The points of the first set, beside the mean spectrum of all sets and its radial mean.
metrics::Drawing pattern_drawing(const std::vector<PointSet>& sets, const PatternDrawingOptions& options = {});

// Powers in a logarithmic grey scale from 0.01 (black) to 100 (white), without the peak at the origin.
metrics::Drawing spectrum_drawing(const Periodogram& spectrum, int size);

}  // namespace etendue::patterns
