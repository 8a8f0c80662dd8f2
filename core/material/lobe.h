// What every lobe of a BSDF speaks: directions of transport, kinds of scattering, the result of sampling.
//
// Directions are local to the shading frame (z is the shading normal), unit, and point away from the surface. `eval`
// leaves the cosine out; densities are per solid angle of wi. A lobe offers
//
//   Color eval(wo, wi, Transport) const;
//   float pdf(wo, wi, Transport) const;
//   bool  sample(wo, u_lobe, u, Transport, LobeSample<Color>&) const;   // false: absorbed
//   float weight(wo) const;                                             // about its albedo: its share when sampling
//   bool  is_delta() const;                                             // eval and pdf are zero
#pragma once
#include "base/vec.h"

namespace etendue {

// Radiance flows from wi to wo as the camera sees it; importance the other way. They differ by eta^2 in refraction.
enum class Transport : uint8_t { radiance, importance };

// Heckbert's letters for a scattering event, and the side that it goes to.
enum class Scatter : uint8_t { diffuse, glossy, specular };

template <class Color>
struct LobeSample {
  Vec3 wi{0};
  Color weight{0};            // f cos / pdf, and the delta's coefficient where `delta`
  float pdf_solid_angle = 0;  // 0 where `delta`
  float eta = 1;              // eta(wi side) / eta(wo side): not 1 after refraction
  Scatter scatter = Scatter::diffuse;
  bool delta = false;
  bool transmitted = false;
};

}  // namespace etendue
