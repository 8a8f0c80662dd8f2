// Directional-hemispherical albedo of a test surface.                              [Lang, sec. 4.2.2.3, eq. 4.156]
#pragma once
#include <array>
#include <vector>

#include "bsdf_analysis/test_surface.h"

namespace etendue::bsdf_analysis {

// The fraction of incident power that leaves the surface, over both hemispheres, estimated with the sampling of the
// lobes. `error` is one standard error of the largest colour component, from replicates.
struct Albedo {
  double degrees = 0;  // polar angle of the incident light
  Rgb value{0};
  double error = 0;
  Rgb diffuse{0}, glossy{0}, specular{0};  // parts by kind of scattering; they sum to `value`
  Rgb transmitted{0};                      // the part that crosses the surface
};

struct AlbedoOptions {
  double azimuth = 20;      // degrees
  uint32_t samples = 2048;  // per direction
};

Albedo albedo_at(const Lobes& lobes, double degrees, const AlbedoOptions& options = {});

// The albedo from 0 to 89.5 degrees, at smaller steps near grazing angles, where models violate energy conservation.
// `inside`: light arrives from below the surface.
std::vector<Albedo> albedo_curve(const Lobes& lobes, bool inside = false, const AlbedoOptions& options = {},
                                 const KeepGoing& keep_going = {});

// The cosine-weighted mean of a curve: the fraction of uniform incident light that leaves the surface.
double hemispherical_albedo(const std::vector<Albedo>& curve);

}  // namespace etendue::bsdf_analysis
