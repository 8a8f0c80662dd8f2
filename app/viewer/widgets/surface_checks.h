// The checks of a material: non-negative, reciprocal, energy-conserving, well sampled.
#pragma once

namespace etendue::viewer {

struct SurfaceMeasurement;
struct UiContext;

// One line per check, with an icon; the tooltip states the measured values. While `measurement` is null, the lines are
// reserved, so that what follows does not move.
void draw_surface_checks(UiContext& ui, const SurfaceMeasurement* measurement);

}  // namespace etendue::viewer
