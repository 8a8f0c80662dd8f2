// Reflectance and transmittance in the nine geometries: light arrives from a direction, a cone or the hemisphere, and the light
// that leaves in a direction, a cone or a hemisphere is measured.          [Lang, sec. 4.2.2.3; Nicodemus et al. 1977]
//
// The reflectance factor relates the flux that leaves to that of a perfect diffuser under the same light,
//
//   R(Ui -> Uo) = pi / (Oi Oo)  integral over Ui and Uo of  f(wi -> wo) cos_i cos_o dwi dwo,
//
// with the projected solid angles Oi and Oo. A Lambertian surface of albedo rho has R = rho in all nine. The reflectance, the
// fraction of the incident flux, is R Oo / pi; it is zero for a single direction. Transmittances measure below the surface.
#pragma once
#include <array>
#include <cstdint>

#include "bsdf_analysis/test_surface.h"

namespace etendue::bsdf_analysis {

enum class Extent : uint8_t { directional, conical, hemispherical };
inline constexpr std::array<const char*, 3> kExtentNames{"directional", "conical", "hemispherical"};

// Cones have their axes in the direction of the light, and in the mirror direction, for transmittance straight on.
struct ReflectanceGeometry {
  double degrees = 45;     // polar angle of the incident light
  double half_angle = 10;  // of the cones, degrees; parts below the horizon do not count
  bool transmission = false;
  uint32_t samples = 1 << 16;
};

struct Reflectance {
  Extent from = Extent::directional, to = Extent::directional;
  Rgb factor{0};     // R
  Rgb fraction{0};   // of the incident flux; 0 for a direction
  double error = 0;  // one standard error of the largest component of `factor`, from replicates
};

// By `from`, then by `to`. Lobes without extent (mirrors) are not part of R for a single direction.
std::array<Reflectance, 9> reflectances(const Lobes& lobes, const ReflectanceGeometry& geometry);

}  // namespace etendue::bsdf_analysis
