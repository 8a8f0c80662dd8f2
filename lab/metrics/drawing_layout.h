// Arrangement of drawings on a common canvas.
#pragma once
#include <vector>

#include "metrics/drawing.h"

namespace etendue::metrics {

// Adds the shapes of `part` to `all`, with the upper left corner of `part` at `corner`, and extends the canvas.
void place(Drawing& all, const Drawing& part, const Point& corner);

// The drawings one below the other, on a canvas of the largest width.
Drawing stacked(const std::vector<Drawing>& drawings);

}  // namespace etendue::metrics
