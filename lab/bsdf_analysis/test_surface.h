// What is put under the instruments of this room: the lobes of one point of a surface.
#pragma once
#include <functional>

#include "material/gltf_surface.h"

namespace etendue::bsdf_analysis {

using Lobes = AllLobes<Rgb>;

// Of a material without its textures, which is what its numbers say.
Lobes lobes_of(const Material& material);

// Unit, `degrees` from the normal; above 90 on the lower side.
Vec3 direction(double degrees, double azimuth_degrees = 0);

// Index of refraction below the surface over that above, as samples tell; 1 where nothing is refracted.
float relative_eta(const Lobes& lobes);

// Whether samples go to the other side.
bool passes_light(const Lobes& lobes);

// Well spread numbers for one sample of a lobe: point i of replicate r of an additive recurrence (R3, M. Roberts 2018)
// with a shift of its own.
LobeRandom draw_of(uint32_t replicate, uint32_t i);

// Goes on while this says so; none is yes.
using Wanted = std::function<bool()>;
inline bool goes_on(const Wanted& wanted) { return !wanted || wanted(); }

}  // namespace etendue::bsdf_analysis
