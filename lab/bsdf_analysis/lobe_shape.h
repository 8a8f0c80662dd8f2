// What f looks like: slices through the plane of incidence, and whole lobes.
#pragma once
#include <vector>

#include "bsdf_analysis/test_surface.h"

namespace etendue::bsdf_analysis {

// In the plane of incidence, for light to wo under `degrees`: angles from -180 to 180 about the surface, 0 the normal,
// positive on wo's side, so that a mirror's direction is at -degrees; beyond +-90 is the lower side.
struct Slice {
  double degrees = 0;
  std::vector<double> angles;
  std::vector<Rgb> values;  // f, times the cosine if so asked
};
Slice slice(const Lobes& lobes, double degrees, bool times_cosine = true, double azimuth = 0, int steps = 1441);

// Values over a sphere of directions: rows from an axis to what lies opposite, closer near the axis, by columns around
// it. The axis is the mirrored direction, or the refracted one for the lower side, as that is where lobes are narrow.
struct LobeSurface {
  int rows = 0, columns = 0;
  std::vector<Vec3> directions;
  std::vector<float> values;  // the mean component; 0 on the other side
  float largest = 0;
};
enum class Side { upper, lower };
LobeSurface lobe_surface(const Lobes& lobes, double degrees, Side side = Side::upper, bool times_cosine = true,
                         double azimuth = 0);

}  // namespace etendue::bsdf_analysis
