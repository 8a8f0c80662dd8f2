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

// The grey value of a power in a logarithmic scale from 0.01 (0) to 100 (1).
double spectrum_grey(double power);

}  // namespace etendue::patterns
