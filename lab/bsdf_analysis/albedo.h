// How much of the light from one direction leaves the surface.                 thesis 4.2.1.3, (4.156); item 42
#pragma once
#include <array>
#include <vector>

#include "bsdf_analysis/test_surface.h"

namespace etendue::bsdf_analysis {

// A share of power, by its own sampling of the lobes: directional-hemispherical, over both hemispheres. `error` is one
// standard error of the largest component, from replicates.
struct Albedo {
  double degrees = 0;  // of the direction that light comes from
  Rgb value{0};
  double error = 0;
  Rgb diffuse{0}, glossy{0}, specular{0};  // the parts by letter, which add up to `value`
  Rgb transmitted{0};                      // the part that goes to the other side
};

struct AlbedoOptions {
  double azimuth = 20;      // degrees
  uint32_t samples = 2048;  // per direction
};

Albedo albedo_at(const Lobes& lobes, double degrees, const AlbedoOptions& options = {});

// From 0 to just short of 90 degrees; more of them where models misbehave. `inside`: of light that comes from below.
std::vector<Albedo> albedo_curve(const Lobes& lobes, bool inside = false, const AlbedoOptions& options = {},
                                 const Wanted& wanted = {});

// The cosine-weighted mean of a curve: what is left of light that comes from everywhere alike.
double hemispherical_albedo(const std::vector<Albedo>& curve);

}  // namespace etendue::bsdf_analysis
