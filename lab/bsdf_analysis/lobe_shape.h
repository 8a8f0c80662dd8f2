// The shape of f: slices in the plane of incidence, and values over a sphere of directions.
#pragma once
#include <vector>

#include "bsdf_analysis/test_surface.h"

namespace etendue::bsdf_analysis {

// Values in the plane of incidence for wo at the polar angle `degrees`. Angles run from -180 to 180 degrees; 0 is the
// normal and positive angles lie on the side of wo, so the mirror direction is at -degrees. Angles beyond +-90 degrees
// are below the surface.
struct Slice {
  double degrees = 0;
  std::vector<double> angles;
  std::vector<Rgb> values;  // f, or f cos if `times_cosine`
};
Slice slice(const Lobes& lobes, double degrees, bool times_cosine = true, double azimuth = 0, int steps = 1441);

// Values on a grid in spherical coordinates around an axis: rows from the axis to the opposite pole, denser near the
// axis, times columns around it. The axis is the mirror direction, or the refracted direction for the lower side,
// because lobes are narrow there.
struct LobeSurface {
  int rows = 0, columns = 0;
  std::vector<Vec3> directions;
  std::vector<float> values;  // mean over the colour components; 0 on the other side of the surface
  float largest = 0;
};
enum class Side { upper, lower };
LobeSurface lobe_surface(const Lobes& lobes, double degrees, Side side = Side::upper, bool times_cosine = true,
                         double azimuth = 0);

}  // namespace etendue::bsdf_analysis
